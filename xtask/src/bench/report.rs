//! The table of a comparison, with what is needed to judge it.

use super::machine;
use super::measure::Run;
use super::peers::Case;
use crate::shell;

/// Medians of one program on one size of picture.
pub(crate) struct Row {
    program: &'static str,
    size: (u32, u32),
    cpu: f64,
    wall: f64,
    tracing: Option<f64>,
    peak: f64,
}

impl Row {
    /// Over all runs that count.
    pub(crate) fn of(case: &Case, runs: &[Run]) -> Row {
        let tracing: Vec<f64> = runs.iter().filter_map(|run| case.tracing(&run.printed)).collect();
        let of = |value: fn(&Run) -> f64| median(runs.iter().map(value).collect()).unwrap_or(f64::NAN);
        Row {
            program: case.program,
            size: case.size,
            cpu: of(|run| run.cpu),
            wall: of(|run| run.wall),
            tracing: median(tracing),
            peak: of(|run| run.peak),
        }
    }

    fn markdown(&self, durer: &Row) -> String {
        let ratio = |ours: f64, theirs: f64| format!("{:.2}", theirs / ours);
        let tracing = self.tracing.map_or("?".to_owned(), |seconds| format!("{seconds:.3}"));
        let tracing_ratio =
            durer.tracing.zip(self.tracing).map_or("?".to_owned(), |(ours, theirs)| ratio(ours, theirs));
        format!(
            "| {} × {} | {} | {:.3} | {:.3} | {tracing} | {:.1} | {} | {tracing_ratio} |\n",
            self.size.0,
            self.size.1,
            self.program,
            self.cpu,
            self.wall,
            self.peak,
            ratio(durer.cpu, self.cpu),
        )
    }
}

/// Prints the report and writes it to benches/runs/.
pub(crate) fn write(rows: &[Row], rounds: usize, versions: &[String]) -> Result<(), String> {
    let (date, processor) = (machine::date()?, machine::processor());
    let text = markdown(rows, rounds, versions, &format!("{date}, {processor}"));
    println!("\n{text}");
    let name = format!("benches/runs/peers-{date}-{}.md", machine::slug(&processor));
    shell::write(&shell::root().join(&name), text)?;
    println!("written to {name}");
    Ok(())
}

fn markdown(rows: &[Row], rounds: usize, versions: &[String], place: &str) -> String {
    let mut text = format!(
        "# The seed's room in durer, POV-Ray and Tachyon\n\n\
         {place}, {} threads; commit {}.\n\
         {}.\n\n\
         One thread, no anti-aliasing, one ray a pixel, depth 5, to a PNG. Medians of {rounds} rounds in which the programs \
         ran in turn,\nafter one more that is not counted. Processor time is user and system time of the whole process; tracing \
         is what each\nprogram reports for it. Ratios are to durer: above 1, durer is faster. POV-Ray waits on timers, so its wall \
         time says\nlittle. Tachyon has no refraction here, and triangles for the cones and the ellipsoid.\n\n\
         | picture | program | CPU s | wall s | tracing s | peak MiB | CPU ÷ durer's | tracing ÷ durer's |\n\
         |---|---|---:|---:|---:|---:|---:|---:|\n",
        machine::cores(),
        machine::commit(),
        versions.join("; "),
    );
    for row in rows {
        if let Some(durer) = rows.iter().find(|other| other.program == "durer" && other.size == row.size) {
            text += &row.markdown(durer);
        }
    }
    text
}

/// The middle one, or the mean of the two in the middle.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = values.get(values.len() / 2)?;
    let lower = values.get((values.len() - 1) / 2)?;
    Some((upper + lower) * 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median(vec![]), None);
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(vec![4.0, 1.0, 2.0, 9.0]), Some(3.0));
    }

    #[test]
    fn ratios_are_to_durer() {
        let row = |program, cpu| Row { program, size: (5, 4), cpu, wall: 1.0, tracing: Some(cpu), peak: 8.0 };
        let text = markdown(&[row("durer", 0.1), row("Tachyon", 0.25)], 7, &["durer 0".to_owned()], "here");
        assert!(text.contains("| 5 × 4 | Tachyon | 0.250 | 1.000 | 0.250 | 8.0 | 2.50 | 2.50 |"), "{text}");
    }
}
