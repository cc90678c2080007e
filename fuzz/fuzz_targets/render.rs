#![no_main]

libfuzzer_sys::fuzz_target!(
    init: {
        // Threads that wait for each other take other branches each time, and the fuzzer would follow them.
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
        alone.build_global().expect("the first to ask for threads");
    },
    |bytes: &[u8]| durer_trials::render(bytes)
);
