//! A plot with two logarithmic axes, as SVG. Its colors are between light and dark, since it cannot know on which of
//! both it is shown.

use durer::math::functions::ln;
use std::f64::consts::LN_10;
use std::fmt::Write;

/// One curve.
pub(super) struct Curve {
    pub(super) name: &'static str,
    /// Pairs of numbers above 0.
    pub(super) points: Vec<(f64, f64)>,
}

/// One of the plots beside each other.
pub(super) struct Panel {
    pub(super) title: &'static str,
    pub(super) curves: [Curve; 3],
}

/// Of a curve, and of the shape that marks its points.
const COLORS: [&str; 3] = ["#d9730d", "#3b82f6", "#16a06b"];

/// All in pixels: the room for one panel with its labels, and the plot in it.
const ROOM: (f64, f64) = (380.0, 280.0);
const LEFT: f64 = 56.0;
const TOP: f64 = 34.0;
const WIDTH: f64 = 300.0;
const HEIGHT: f64 = 190.0;

/// The whole picture.
pub(super) fn draw(panels: &[Panel; 2]) -> String {
    let (width, height) = (2.0 * ROOM.0, ROOM.1);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"#808080\" stroke=\"none\">\n"
    );
    for (index, panel) in panels.iter().enumerate() {
        let _ = writeln!(svg, "<g transform=\"translate({} 0)\">", ROOM.0 * index as f64);
        svg += &panel_inside(panel);
        svg += "</g>\n";
    }
    svg + "</svg>\n"
}

fn panel_inside(panel: &Panel) -> String {
    let all = || panel.curves.iter().flat_map(|curve| curve.points.iter().copied());
    let (x, y) = (Axis::around(all().map(|point| point.0)), Axis::around(all().map(|point| point.1)));
    let mut svg = format!("<text x=\"{LEFT}\" y=\"{}\" font-size=\"14\">{}</text>\n", TOP - 14.0, panel.title);
    for power in x.powers() {
        let at = LEFT + x.share(power) * WIDTH;
        svg += &line((at, TOP), (at, TOP + HEIGHT));
        svg += &label((at, TOP + HEIGHT + 18.0), "middle", power);
    }
    for power in y.powers() {
        let at = TOP + HEIGHT - y.share(power) * HEIGHT;
        svg += &line((LEFT, at), (LEFT + WIDTH, at));
        svg += &label((LEFT - 8.0, at + 4.0), "end", power);
    }
    let below = TOP + HEIGHT + 38.0;
    let _ = writeln!(svg, "<text x=\"{}\" y=\"{below}\" text-anchor=\"middle\">things</text>", LEFT + WIDTH / 2.0);
    for (index, curve) in panel.curves.iter().enumerate() {
        svg += &curve_in(curve, index, &x, &y);
    }
    svg
}

fn curve_in(curve: &Curve, index: usize, x: &Axis, y: &Axis) -> String {
    let place = |&(a, b): &(f64, f64)| (LEFT + x.share(log10(a)) * WIDTH, TOP + HEIGHT - y.share(log10(b)) * HEIGHT);
    let places: Vec<(f64, f64)> = curve.points.iter().map(place).collect();
    let path: Vec<String> = places.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    let color = COLORS[index % COLORS.len()];
    let mut svg =
        format!("<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>\n", path.join(" "));
    for &place in &places {
        svg += &mark(place, index, color);
    }
    // The names stand in the corner above left, where curves that rise do not come.
    let at = TOP + 18.0 + 18.0 * index as f64;
    svg += &mark((LEFT + 14.0, at - 4.0), index, color);
    let _ = writeln!(svg, "<text x=\"{}\" y=\"{at}\" fill=\"{color}\">{}</text>", LEFT + 24.0, curve.name);
    svg
}

/// A triangle, a circle or a square, so that curves are told apart without their colors.
fn mark((x, y): (f64, f64), index: usize, color: &str) -> String {
    match index {
        0 => format!("<path d=\"M{:.1} {:.1}l5 8.5h-10z\" fill=\"{color}\"/>\n", x, y - 5.5),
        1 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{color}\"/>\n"),
        _ => format!("<rect x=\"{:.1}\" y=\"{:.1}\" width=\"7\" height=\"7\" fill=\"{color}\"/>\n", x - 3.5, y - 3.5),
    }
}

fn line(from: (f64, f64), to: (f64, f64)) -> String {
    format!(
        "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#808080\" stroke-opacity=\"0.4\"/>\n",
        from.0, from.1, to.0, to.1
    )
}

/// A power of ten: as a plain number if it is short, since not every font has a raised minus.
fn label((x, y): (f64, f64), anchor: &str, power: f64) -> String {
    let number = match power as i32 {
        power @ 0..=2 => 10_u32.pow(power.unsigned_abs()).to_string(),
        power @ -4..0 => format!("0.{:0>1$}", 1, power.unsigned_abs() as usize),
        power => format!("10{}", raised(power)),
    };
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{number}</text>\n")
}

/// A number as an exponent.
fn raised(number: i32) -> String {
    let of = |character| match character {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit @ '4'..='9' => char::from_u32('⁴' as u32 + digit as u32 - '4' as u32).unwrap_or(digit),
        _ => '⁰',
    };
    number.to_string().chars().map(of).collect()
}

/// An axis from one power of ten to another.
struct Axis {
    from: f64,
    to: f64,
}

impl Axis {
    /// With room for all these numbers.
    fn around(numbers: impl Iterator<Item = f64>) -> Axis {
        let logarithms = numbers.filter(|&number| number > 0.0).map(log10);
        let (least, greatest) =
            logarithms.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), log| (low.min(log), high.max(log)));
        // Counts are powers of ten only nearly, for grids must be square.
        let (from, to) = ((least + 0.02).floor(), (greatest - 0.02).ceil());
        if least > greatest { Axis { from: 0.0, to: 1.0 } } else { Axis { from, to: to.max(from + 1.0) } }
    }

    /// The exponents of the powers of ten on it.
    fn powers(&self) -> impl Iterator<Item = f64> {
        let from = self.from;
        (0..=(self.to - from) as u32).map(move |step| from + f64::from(step))
    }

    /// How far along the axis a logarithm is, from 0 to 1.
    fn share(&self, log: f64) -> f64 {
        (log - self.from) / (self.to - self.from)
    }
}

fn log10(x: f64) -> f64 {
    ln(x) / LN_10
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_begin_and_end_at_powers_of_ten() {
        let axis = Axis::around([998.0, 20.0, 5e5].into_iter());
        assert_eq!((axis.from, axis.to), (1.0, 6.0));
        assert_eq!(axis.powers().collect::<Vec<_>>(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert!((axis.share(3.5) - 0.5).abs() < 1e-12);
        let axis = Axis::around([998.0, 1001.0].into_iter());
        assert_eq!((axis.from, axis.to), (3.0, 4.0));
    }

    #[test]
    fn powers_of_ten_are_written() {
        let written = |power| {
            let label = label((0.0, 0.0), "end", power);
            label.split(['<', '>']).nth(2).map(str::to_owned).unwrap()
        };
        assert_eq!(
            [-5.0, -4.0, -1.0, 0.0, 2.0, 3.0, 13.0].map(written),
            ["10⁻⁵", "0.0001", "0.1", "1", "100", "10³", "10¹³"]
        );
    }

    #[test]
    fn points_lie_where_their_logarithms_are() {
        let curve = |points: &[(f64, f64)]| Curve { name: "n", points: points.to_vec() };
        let panel =
            || Panel { title: "t", curves: [curve(&[(1.0, 1.0), (100.0, 100.0)]), curve(&[(10.0, 10.0)]), curve(&[])] };
        let svg = draw(&[panel(), panel()]);
        let (left, right, bottom) = (LEFT, LEFT + WIDTH, TOP + HEIGHT);
        assert!(svg.contains(&format!("points=\"{left:.1},{bottom:.1} {right:.1},{TOP:.1}\"")), "{svg}");
        assert!(svg.contains(&format!("cx=\"{:.1}\" cy=\"{:.1}\"", LEFT + WIDTH / 2.0, TOP + HEIGHT / 2.0)), "{svg}");
        assert_eq!(svg.matches("<polyline").count(), 6);
    }
}
