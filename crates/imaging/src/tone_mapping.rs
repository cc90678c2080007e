//! Tone mapping: how light of any strength becomes what a screen can show.

/// How linear light above 1 is brought into what a screen can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMapping {
    /// Not at all: what is above 1 is white.
    #[default]
    None,
    /// That of Reinhard and others 2002.
    Reinhard,
    /// A fit of the Academy Color Encoding System's reference transforms.
    Aces,
    /// AgX, after Troy Sobotka.
    Agx,
    /// Khronos PBR Neutral: leaves colors below its shoulder as they are.
    PbrNeutral,
}
