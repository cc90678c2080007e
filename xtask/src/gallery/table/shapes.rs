//! Shapes, solids, meshes and particles.

use super::{Entry, FINE, Picture};

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "Shapes",
        text: "All nine. They are exact, not made of triangles.",
        pictures: &[Picture {
            name: "shapes",
            caption: "a cylinder, a box, a cone, a frustum, a disc with a hole, a ball, a torus, a rectangle and a \
                      tetrahedron of triangles on a plinth",
            scene: "scenes/gallery/shapes.yaml",
            ..FINE
        }],
    },
    Entry {
        heading: "Solids",
        text: "Union, intersection and difference. A cut surface has the material of what cuts: brass in the cube, \
               white in the dice, turquoise in the cup.",
        pictures: &[Picture {
            name: "solids",
            caption: "a rounded cube with three round holes, a cup of tea and two red dice on a wooden table",
            scene: "scenes/gallery/solids.yaml",
            ..FINE
        }],
    },
    Entry {
        heading: "Meshes",
        text: "A knot of 2496 triangles from a PLY file, which has a normal and a color for each vertex. Since it \
               has no holes, it can be of glass.",
        pictures: &[
            Picture { name: "knot-flat", caption: "`normals: flat`", scene: "scenes/gallery/knot-flat.yaml", ..FINE },
            Picture {
                name: "knot-smooth",
                caption: "with the normals of the file",
                scene: "scenes/gallery/knot-smooth.yaml",
                ..FINE
            },
            Picture { name: "knot-glass", caption: "of glass", scene: "scenes/gallery/knot-glass.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "Models",
        text: "All of an OBJ file with the materials of its MTL file; the sea and the evening are of the scene.",
        pictures: &[Picture {
            name: "lighthouse",
            caption: "a red and white lighthouse and a small house on a rock, mirrored in the sea",
            scene: "scenes/gallery/lighthouse.yaml",
            ..FINE
        }],
    },
    Entry {
        heading: "Molecules and crystals",
        text: "Atoms from an .xyz file as balls, bonds from a table as cylinders; and bonds alone, as capsules.",
        pictures: &[
            Picture { name: "caffeine", caption: "caffeine", scene: "scenes/gallery/caffeine.yaml", ..FINE },
            Picture { name: "diamond", caption: "diamond", scene: "scenes/gallery/diamond.yaml", ..FINE },
        ],
    },
    Entry {
        heading: "A field of arrows",
        text: "The magnetic field of a current in a ring. Shafts, heads and colors of all arrows come from one \
               table of numbers.",
        pictures: &[Picture {
            name: "field",
            caption: "hundreds of arrows around a copper ring, red near it and blue far from it",
            scene: "scenes/gallery/field.yaml",
            ..FINE
        }],
    },
];
