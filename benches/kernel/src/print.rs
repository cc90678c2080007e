//! What the programs print: one JSON object a line, for `cargo xtask bench kernel` to gather.

/// Who measures what. Words hold nothing that JSON would escape.
#[derive(Clone, Copy, Debug)]
pub struct Lines<'a> {
    /// The program.
    pub program: &'a str,
    /// The quality of its tree, or nothing if there is but one.
    pub variant: &'a str,
    /// The scene.
    pub scene: &'a str,
}

impl Lines<'_> {
    /// The scene, to be compared with that of other programs.
    pub fn scene(&self, count: usize, hashes: &[u64]) {
        let hashes: Vec<String> = hashes.iter().map(|hash| format!("\"{hash:016x}\"")).collect();
        self.line("scene", &format!("\"count\": {count}, \"hashes\": [{}]", hashes.join(", ")));
    }

    /// Seconds of building, bytes held by what was built, and bytes of the lists that it needs beside.
    pub fn build(&self, seconds: f64, bytes: usize, list_bytes: usize) {
        self.line("build", &format!("\"seconds\": {seconds}, \"bytes\": {bytes}, \"list_bytes\": {list_bytes}"));
    }

    /// Rays of one kind, sent in one way.
    pub fn rays(&self, rays: &str, way: &str, count: usize, run: &crate::measure::Run) {
        let rate = count as f64 / run.seconds * 1e-6;
        let (hits, sum) = (run.found.hits, run.found.sum);
        self.line(
            "rays",
            &format!(
                "\"rays\": \"{rays}\", \"way\": \"{way}\", \"count\": {count}, \"million_a_second\": {rate}, \
                 \"hits\": {hits}, \"distances\": {sum}"
            ),
        );
    }

    fn line(&self, measure: &str, rest: &str) {
        let Lines { program, variant, scene } = self;
        println!(
            "{{\"program\": \"{program}\", \"variant\": \"{variant}\", \"scene\": \"{scene}\", \"measure\": \"{measure}\", {rest}}}"
        );
    }
}
