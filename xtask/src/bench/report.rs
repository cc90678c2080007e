//! Tables of comparisons, and where they are kept.

use super::machine;
use super::measure::Run;
use super::programs::Case;
use crate::shell;

/// Medians of one program on one picture.
pub(crate) struct Row {
    program: &'static str,
    subject: String,
    cpu: f64,
    wall: f64,
    tracing: Option<f64>,
    peak: f64,
}

impl Row {
    /// Over all runs that count.
    pub(crate) fn of(case: &Case, runs: &[Run]) -> Row {
        let tracing: Vec<f64> = runs.iter().filter_map(|run| (case.tracing)(&run.printed)).collect();
        let of = |value: fn(&Run) -> f64| median(runs.iter().map(value).collect()).unwrap_or(f64::NAN);
        Row {
            program: case.program,
            subject: case.subject.clone(),
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
            "| {} | {} | {:.3} | {:.3} | {tracing} | {:.1} | {} | {tracing_ratio} |\n",
            self.subject,
            self.program,
            self.cpu,
            self.wall,
            self.peak,
            ratio(durer.cpu, self.cpu),
        )
    }
}

/// A table with a line for each row; `subject` heads its first column. Ratios are to the first row of the same subject.
pub(crate) fn table(subject: &str, rows: &[Row]) -> String {
    let mut text = format!(
        "| {subject} | program | CPU s | wall s | tracing s | peak MiB | CPU ÷ durer's | tracing ÷ durer's |\n\
         |---|---|---:|---:|---:|---:|---:|---:|\n"
    );
    for row in rows {
        if let Some(durer) = rows.iter().find(|other| other.subject == row.subject) {
            text += &row.markdown(durer);
        }
    }
    text
}

/// When, on what and of which commit something was measured.
pub(crate) fn place() -> Result<String, String> {
    let (date, processor) = (machine::date()?, machine::processor());
    Ok(format!("{date}, {processor}, {} threads; commit {}.", machine::cores(), machine::commit()))
}

/// Prints a report and writes it to benches/runs/.
pub(crate) fn keep(kind: &str, text: &str) -> Result<(), String> {
    println!("\n{text}");
    let name = format!("benches/runs/{kind}-{}-{}.md", machine::date()?, machine::slug(&machine::processor()));
    shell::write(&shell::root().join(&name), text)?;
    println!("written to {name}");
    Ok(())
}

/// The middle one, or the mean of the two in the middle.
pub(crate) fn median(mut values: Vec<f64>) -> Option<f64> {
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
        let row =
            |program, cpu| Row { program, subject: "5 × 4".to_owned(), cpu, wall: 1.0, tracing: Some(cpu), peak: 8.0 };
        let text = table("picture", &[row("durer", 0.1), row("Tachyon", 0.25)]);
        assert!(text.contains("| 5 × 4 | Tachyon | 0.250 | 1.000 | 0.250 | 8.0 | 2.50 | 2.50 |"), "{text}");
    }
}
