//! The scene for durer: a small file that says how it looks, beside two tables with the shapes.

use super::things::{AMBIENT, BACKGROUND, DIFFUSE, EYE, FLOOR, HALF_HEIGHT, LAMP, PALETTE, Thing, things};
use std::io::{self, Write};

/// The endings of tables.
pub(super) const FORMATS: [&str; 2] = ["csv", "npy"];

const BALL_COLUMNS: &str = "x,y,z,radius,r,g,b";
const ROD_COLUMNS: &str = "x0,y0,z0,x1,y1,z1,radius,r,g,b";

/// The scene file, with the names of the tables.
pub(super) fn scene(size: u32, balls: &str, rods: &str) -> String {
    let (eye, lamp) = (EYE.to_array(), LAMP.to_array());
    format!(
        "camera: {{position: {eye:?}, look_at: [0, 0, 0], image_plane: {{distance: 1, half_height: {HALF_HEIGHT}}}}}\n\
         picture: {{width: {size}, height: {size}}}\n\
         background: {BACKGROUND:?}\n\
         lights: [point: {{position: {lamp:?}}}]\n\
         materials:\n\
         \x20 matte: {{color: white, ambient: {AMBIENT}, diffuse: {DIFFUSE}, specular: 0}}\n\
         objects:\n\
         \x20 - plane: {{point: [0, {FLOOR}, 0], material: matte}}\n\
         \x20 - spheres: {{file: {balls}, material: matte}}\n\
         \x20 - cylinders: {{file: {rods}, open: true, material: matte}}\n"
    )
}

/// The table of balls.
pub(super) fn balls(count: usize, format: &str, out: &mut impl Write) -> io::Result<()> {
    let rows = things(count).filter_map(|thing| match thing {
        Thing::Ball { center: [x, y, z], radius, color } => Some(with_color([x, y, z, radius], color)),
        Thing::Rod { .. } => None,
    });
    table(BALL_COLUMNS, count.div_ceil(2), rows, format, out)
}

/// The table of rods.
pub(super) fn rods(count: usize, format: &str, out: &mut impl Write) -> io::Result<()> {
    let rows = things(count).filter_map(|thing| match thing {
        Thing::Ball { .. } => None,
        Thing::Rod { base: [a, b, c], top: [x, y, z], radius, color } => {
            Some(with_color([a, b, c, x, y, z, radius], color))
        }
    });
    table(ROD_COLUMNS, count / 2, rows, format, out)
}

fn with_color<const N: usize>(numbers: [f32; N], color: usize) -> Vec<f32> {
    numbers.into_iter().chain(PALETTE[color].map(|x| x as f32)).collect()
}

fn table(
    columns: &str,
    count: usize,
    rows: impl Iterator<Item = Vec<f32>>,
    format: &str,
    out: &mut impl Write,
) -> io::Result<()> {
    match format {
        "csv" => csv(columns, rows, out)?,
        _ => npy(columns.split(',').count(), count, rows, out)?,
    }
    out.flush()
}

fn csv(columns: &str, rows: impl Iterator<Item = Vec<f32>>, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "{columns}")?;
    for row in rows {
        let row: Vec<String> = row.iter().map(f32::to_string).collect();
        writeln!(out, "{}", row.join(","))?;
    }
    Ok(())
}

/// NumPy's format, version 1: the header is padded so that the numbers begin at a multiple of 64.
fn npy(width: usize, count: usize, rows: impl Iterator<Item = Vec<f32>>, out: &mut impl Write) -> io::Result<()> {
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({count}, {width}), }}");
    // Ten bytes before it, and the end of the line.
    let padded = (header.len() + 11).next_multiple_of(64) - 11;
    out.write_all(b"\x93NUMPY\x01\x00")?;
    out.write_all(&(padded as u16 + 1).to_le_bytes())?;
    writeln!(out, "{header:padded$}")?;
    for number in rows.flatten() {
        out.write_all(&number.to_le_bytes())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(write: fn(usize, &str, &mut Vec<u8>) -> io::Result<()>, format: &str) -> Vec<u8> {
        let mut out = Vec::new();
        write(11, format, &mut out).unwrap();
        out
    }

    #[test]
    fn text_tables_have_a_row_for_each() {
        let (balls, rods) = (written(balls, "csv"), written(rods, "csv"));
        let lines =
            |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap().lines().map(str::to_owned).collect::<Vec<_>>();
        assert_eq!((lines(&balls).len(), lines(&rods).len()), (1 + 6, 1 + 5));
        assert!(lines(&balls).iter().all(|line| line.split(',').count() == 7));
        assert!(lines(&rods)[1].ends_with(",0.2,0.8,0.2"), "{}", lines(&rods)[1]);
    }

    #[test]
    fn binary_tables_have_the_same_numbers() {
        let (text, binary) = (written(rods, "csv"), written(rods, "npy"));
        let length = usize::from(u16::from_le_bytes([binary[8], binary[9]]));
        assert_eq!(((10 + length) % 64, binary[9 + length]), (0, b'\n'));
        let numbers = binary[10 + length..].as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes));
        let text = String::from_utf8(text).unwrap();
        let expected = text.lines().skip(1).flat_map(|line| line.split(',')).map(|word| word.parse::<f32>().unwrap());
        assert!(numbers.eq(expected));
    }

    #[test]
    fn the_scene_names_its_tables() {
        let scene = scene(64, "a.csv", "b.csv");
        assert!(scene.contains("spheres: {file: a.csv") && scene.contains("cylinders: {file: b.csv"), "{scene}");
    }
}
