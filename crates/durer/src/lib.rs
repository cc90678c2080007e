//! durer
