//! How long a render will take still, from how fast it was of late.

use std::collections::VecDeque;

/// How far a render had come, and when. Times are seconds since it began.
#[derive(Clone, Debug)]
pub(crate) struct Pace {
    /// Time and finished pixels, oldest first; the first is the last one within the first half of the time.
    marks: VecDeque<(f64, u64)>,
}

/// No word about what is left before so many seconds have passed …
const SECONDS: f64 = 1.0;

/// … and pixels were finished so many times.
const TIMES: usize = 4;

impl Pace {
    /// Of a render that begins with so many pixels finished.
    pub(crate) fn new(already: u64) -> Pace {
        Pace { marks: VecDeque::from([(0.0, already)]) }
    }

    /// So many pixels are finished by now.
    pub(crate) fn note(&mut self, seconds: f64, finished: u64) {
        // A few hundred marks are plenty, however many tiles there are.
        let close =
            self.marks.len() > TIMES && self.marks.back().is_some_and(|last| seconds - last.0 < seconds / 500.0);
        if close {
            self.marks.pop_back();
        }
        self.marks.push_back((seconds, finished));
        while self.marks.get(1).is_some_and(|second| second.0 <= 0.5 * seconds) && self.marks.len() > TIMES {
            self.marks.pop_front();
        }
    }

    /// Seconds until `of` pixels are finished, if it goes on as in the second half of the time so far, up to now; `None`
    /// before there is something to go by.
    pub(crate) fn remaining(&self, seconds: f64, of: u64) -> Option<f64> {
        let ((since, before), (_, finished)) = (self.marks.front()?, self.marks.back()?);
        let gained = finished.saturating_sub(*before);
        let left = of.saturating_sub(*finished);
        if left == 0 {
            return Some(0.0);
        }
        let enough = seconds >= SECONDS && self.marks.len() >= TIMES && gained > 0;
        enough.then(|| (seconds - since) / gained as f64 * left as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_pace_is_foretold_exactly() {
        let mut pace = Pace::new(0);
        for second in 1..=40 {
            pace.note(f64::from(second), 10 * second as u64);
            if second >= 4 {
                let remaining = pace.remaining(f64::from(second), 1000).unwrap();
                assert!((remaining - f64::from(100 - second)).abs() < 1e-9, "{second}: {remaining}");
            }
        }
        assert_eq!(pace.remaining(40.0, 400), Some(0.0));
    }

    #[test]
    fn nothing_is_said_too_early() {
        let mut pace = Pace::new(500);
        assert_eq!(pace.remaining(10.0, 1000), None);
        for (seconds, finished) in [(0.1, 510), (0.2, 520), (0.3, 530)] {
            pace.note(seconds, finished);
        }
        assert_eq!(pace.remaining(0.4, 1000), None);
        assert!(pace.remaining(1.0, 1000).is_some());
    }

    /// What was finished before this run says nothing of its pace.
    #[test]
    fn a_render_that_goes_on_has_its_own_pace() {
        let mut pace = Pace::new(900);
        (1..=5).for_each(|second| pace.note(f64::from(second), 900 + second as u64));
        let remaining = pace.remaining(5.0, 1000).unwrap();
        assert!((remaining - 95.0).abs() < 1e-9, "{remaining}");
    }

    /// A sky in no time, then a forest: soon it is the forest that counts; and while nothing comes, it takes longer.
    #[test]
    fn the_second_half_of_the_time_counts() {
        let mut pace = Pace::new(0);
        (1..=10).for_each(|second| pace.note(f64::from(second), 50 * second as u64));
        (11..=40).for_each(|second| pace.note(f64::from(second), 490 + second as u64));
        let remaining = pace.remaining(40.0, 1000).unwrap();
        assert!((remaining - 470.0).abs() < 40.0, "{remaining}");
        assert!(pace.remaining(80.0, 1000).unwrap() > 2.0 * remaining);
    }

    #[test]
    fn marks_stay_few() {
        let mut pace = Pace::new(0);
        (1..=100_000).for_each(|step: u64| pace.note(step as f64 / 100.0, step));
        assert!(pace.marks.len() < 1000, "{}", pace.marks.len());
    }
}
