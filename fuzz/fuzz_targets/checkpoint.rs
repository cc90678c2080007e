#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| durer_trials::checkpoint(bytes));
