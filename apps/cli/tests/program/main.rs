//! The program, run as a program: what it writes, what it says, and how it ends.

mod checkpoint;
mod compare;
mod develop;
mod explain;
mod films;
mod heatmap;
mod hostile;
mod inspect;
mod interrupt;
mod limits;
mod models;
mod render;
mod texts;
mod workshop;
