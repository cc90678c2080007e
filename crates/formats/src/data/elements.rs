//! What atoms look like by convention.

/// The elements in the order of their numbers: symbol, covalent radius in picometers (Cordero et al., "Covalent radii
/// revisited", Dalton Transactions 2008; from berkelium on, where none is known, that of curium), and the color of Jmol,
/// which goes back to Corey, Pauling and Koltun, as sRGB.
#[rustfmt::skip]
const ELEMENTS: [(&str, u16, u32); 109] = [
    ("H", 31, 0xffffff), ("He", 28, 0xd9ffff), ("Li", 128, 0xcc80ff), ("Be", 96, 0xc2ff00), ("B", 84, 0xffb5b5),
    ("C", 76, 0x909090), ("N", 71, 0x3050f8), ("O", 66, 0xff0d0d), ("F", 57, 0x90e050), ("Ne", 58, 0xb3e3f5),
    ("Na", 166, 0xab5cf2), ("Mg", 141, 0x8aff00), ("Al", 121, 0xbfa6a6), ("Si", 111, 0xf0c8a0), ("P", 107, 0xff8000),
    ("S", 105, 0xffff30), ("Cl", 102, 0x1ff01f), ("Ar", 106, 0x80d1e3), ("K", 203, 0x8f40d4), ("Ca", 176, 0x3dff00),
    ("Sc", 170, 0xe6e6e6), ("Ti", 160, 0xbfc2c7), ("V", 153, 0xa6a6ab), ("Cr", 139, 0x8a99c7), ("Mn", 139, 0x9c7ac7),
    ("Fe", 132, 0xe06633), ("Co", 126, 0xf090a0), ("Ni", 124, 0x50d050), ("Cu", 132, 0xc88033), ("Zn", 122, 0x7d80b0),
    ("Ga", 122, 0xc28f8f), ("Ge", 120, 0x668f8f), ("As", 119, 0xbd80e3), ("Se", 120, 0xffa100), ("Br", 120, 0xa62929),
    ("Kr", 116, 0x5cb8d1), ("Rb", 220, 0x702eb0), ("Sr", 195, 0x00ff00), ("Y", 190, 0x94ffff), ("Zr", 175, 0x94e0e0),
    ("Nb", 164, 0x73c2c9), ("Mo", 154, 0x54b5b5), ("Tc", 147, 0x3b9e9e), ("Ru", 146, 0x248f8f), ("Rh", 142, 0x0a7d8c),
    ("Pd", 139, 0x006985), ("Ag", 145, 0xc0c0c0), ("Cd", 144, 0xffd98f), ("In", 142, 0xa67573), ("Sn", 139, 0x668080),
    ("Sb", 139, 0x9e63b5), ("Te", 138, 0xd47a00), ("I", 139, 0x940094), ("Xe", 140, 0x429eb0), ("Cs", 244, 0x57178f),
    ("Ba", 215, 0x00c900), ("La", 207, 0x70d4ff), ("Ce", 204, 0xffffc7), ("Pr", 203, 0xd9ffc7), ("Nd", 201, 0xc7ffc7),
    ("Pm", 199, 0xa3ffc7), ("Sm", 198, 0x8fffc7), ("Eu", 198, 0x61ffc7), ("Gd", 196, 0x45ffc7), ("Tb", 194, 0x30ffc7),
    ("Dy", 192, 0x1fffc7), ("Ho", 192, 0x00ff9c), ("Er", 189, 0x00e675), ("Tm", 190, 0x00d452), ("Yb", 187, 0x00bf38),
    ("Lu", 187, 0x00ab24), ("Hf", 175, 0x4dc2ff), ("Ta", 170, 0x4da6ff), ("W", 162, 0x2194d6), ("Re", 151, 0x267dab),
    ("Os", 144, 0x266696), ("Ir", 141, 0x175487), ("Pt", 136, 0xd0d0e0), ("Au", 136, 0xffd123), ("Hg", 132, 0xb8b8d0),
    ("Tl", 145, 0xa6544d), ("Pb", 146, 0x575961), ("Bi", 148, 0x9e4fb5), ("Po", 140, 0xab5c00), ("At", 150, 0x754f45),
    ("Rn", 150, 0x428296), ("Fr", 260, 0x420066), ("Ra", 221, 0x007d00), ("Ac", 215, 0x70abfa), ("Th", 206, 0x00baff),
    ("Pa", 200, 0x00a1ff), ("U", 196, 0x008fff), ("Np", 190, 0x0080ff), ("Pu", 187, 0x006bff), ("Am", 180, 0x545cf2),
    ("Cm", 169, 0x785ce3), ("Bk", 169, 0x8a4fe3), ("Cf", 169, 0xa136d4), ("Es", 169, 0xb31fd4), ("Fm", 169, 0xb31fba),
    ("Md", 169, 0xb30da6), ("No", 169, 0xbd0d87), ("Lr", 169, 0xc70066), ("Rf", 169, 0xcc0059), ("Db", 169, 0xd1004f),
    ("Sg", 169, 0xd90045), ("Bh", 169, 0xe00038), ("Hs", 169, 0xe6002e), ("Mt", 169, 0xeb0026),
];

/// How an atom is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    /// Covalent radius in ångström.
    pub(super) radius: f64,
    /// sRGB.
    pub(super) color: [u8; 3],
}

/// What is no element: 1 Å, deep pink.
pub(super) const UNKNOWN: Look = Look { radius: 1.0, color: [0xff, 0x14, 0x93] };

/// Looks by symbol, without a search for each of a million atoms.
pub(super) struct Looks {
    /// By first letter, and second letter from 1.
    by_letters: Vec<Option<Look>>,
}

impl Looks {
    pub(super) fn new() -> Looks {
        let mut by_letters = vec![None; 26 * 27];
        for (at, (symbol, ..)) in ELEMENTS.iter().enumerate() {
            if let Some(slot) = slot(symbol.as_bytes()) {
                by_letters[slot] = Some(look(at));
            }
        }
        // Heavy hydrogen.
        for isotope in [b"D", b"T"] {
            if let Some(slot) = slot(isotope) {
                by_letters[slot] = Some(look(0));
            }
        }
        Looks { by_letters }
    }

    /// The look of an atom called by its symbol in any case, its number, or a label such as `C12`.
    pub(super) fn of(&self, symbol: &[u8]) -> Option<Look> {
        if symbol.first()?.is_ascii_digit() {
            let number: usize = std::str::from_utf8(symbol).ok()?.parse().ok()?;
            return (1..=ELEMENTS.len()).contains(&number).then(|| look(number - 1));
        }
        let letters = symbol.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        let rest = &symbol[letters..];
        if rest.first().is_some_and(|byte| !byte.is_ascii_digit() && !matches!(byte, b'+' | b'-' | b'_' | b'*')) {
            return None;
        }
        self.by_letters[slot(&symbol[..letters])?]
    }
}

fn look(at: usize) -> Look {
    let (_, picometers, color) = ELEMENTS[at];
    let [_, r, g, b] = color.to_be_bytes();
    Look { radius: f64::from(picometers) / 100.0, color: [r, g, b] }
}

fn slot(letters: &[u8]) -> Option<usize> {
    let index = |letter: u8| letter.is_ascii_alphabetic().then(|| usize::from(letter.to_ascii_lowercase() - b'a'));
    match letters {
        [first] => Some(index(*first)? * 27),
        [first, second] => Some(index(*first)? * 27 + index(*second)? + 1),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn atoms_are_known_by_symbol_number_and_label() {
        let looks = Looks::new();
        let carbon = Look { radius: 0.76, color: [0x90; 3] };
        for name in ["C", "c", "6", "C12", "C+", "C_3"] {
            assert_eq!(looks.of(name.as_bytes()), Some(carbon), "{name}");
        }
        let oxygen = looks.of(b"O").unwrap();
        assert_eq!((oxygen.radius, oxygen.color), (0.66, [255, 13, 13]));
        assert_eq!(looks.of(b"CL"), looks.of(b"17"));
        assert_eq!(looks.of(b"D"), looks.of(b"H"));
        assert_eq!(looks.of(b"Mt"), looks.of(b"109"));
        for name in ["", "X", "Xyz", "0", "110", "C.1", "\u{fc}", "1e3"] {
            assert_eq!(looks.of(name.as_bytes()), None, "{name}");
        }
    }

    #[test]
    fn no_two_elements_share_a_symbol() {
        let slots: std::collections::BTreeSet<_> =
            ELEMENTS.iter().map(|(symbol, ..)| slot(symbol.as_bytes())).collect();
        assert_eq!(slots.len(), ELEMENTS.len());
    }
}
