//! What is in the gallery, in the order of the page. A new picture is one more entry here and a scene in `scenes/`.

/// One heading of the page: a picture, or two that differ in one thing.
pub(crate) struct Entry {
    pub(crate) heading: &'static str,
    /// One or two sentences.
    pub(crate) text: &'static str,
    /// One picture, or two to be shown side by side.
    pub(crate) pictures: &'static [Picture],
}

/// One picture.
pub(crate) struct Picture {
    /// Name of its file in docs/gallery, without extension.
    pub(crate) name: &'static str,
    /// What is to be seen, in a few words: stands above one of a pair, and for those who cannot see it.
    pub(crate) caption: &'static str,
    /// What of `durer` makes it: `render` or `heatmap`.
    pub(crate) command: &'static str,
    /// The scene, from the root of the repository.
    pub(crate) scene: &'static str,
    /// More for the command line.
    pub(crate) arguments: &'static [&'static str],
}

impl Picture {
    /// Name of its file.
    pub(crate) fn file(&self) -> String {
        format!("{}.png", self.name)
    }

    /// What one types to make it.
    pub(crate) fn command_line(&self) -> String {
        let words = ["durer", self.command, self.scene, "-o"].into_iter().map(str::to_owned);
        let arguments = self.arguments.iter().map(|word| (*word).to_owned());
        words.chain([self.file()]).chain(arguments).collect::<Vec<_>>().join(" ")
    }
}

/// The gallery.
pub(crate) const ENTRIES: &[Entry] = &[
    Entry {
        heading: "The room",
        text: "Where durer comes from, a student's ray tracer of years ago: planes, spheres, cylinders and cones, a \
               mirror, a clear and a refracting ball, an image on a cylinder, two lamps, a spotlight, and fog.",
        pictures: &[Picture {
            name: "room",
            caption: "a room with balls, cones and cylinders on a checkered table",
            command: "render",
            scene: "scenes/room.yaml",
            arguments: &["--width", "640", "--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "A still life",
        text: "After Dürer's engraving Melencolia I: the solid, the ball, the ladder, the hourglass, the dividers, \
               the magic square.",
        pictures: &[Picture {
            name: "melencolia",
            caption: "a marble solid, balls of stone, glass and brass, an hourglass and a ladder in a dark room",
            command: "render",
            scene: "scenes/gallery/melencolia.yaml",
            arguments: &[],
        }],
    },
    Entry {
        heading: "Five lines",
        text: "Everything that a scene does not say has a default: camera, lights, sky and size of the picture.",
        pictures: &[Picture {
            name: "five-lines",
            caption: "a ball, a cone and a cylinder on a checkered floor",
            command: "render",
            scene: "scenes/gallery/five-lines.yaml",
            arguments: &["--width", "480"],
        }],
    },
    Entry {
        heading: "Shapes",
        text: "All nine. They are exact, not made of triangles.",
        pictures: &[Picture {
            name: "shapes",
            caption: "a cylinder, a box, a cone, a frustum, a disc with a hole, a ball, a torus, a rectangle and a \
                      tetrahedron of triangles on a plinth",
            command: "render",
            scene: "scenes/gallery/shapes.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Solids",
        text: "Union, intersection and difference. A cut surface has the material of what cuts: brass in the cube, \
               white in the dice, turquoise in the cup.",
        pictures: &[Picture {
            name: "solids",
            caption: "a rounded cube with three round holes, a cup of tea and two red dice on a wooden table",
            command: "render",
            scene: "scenes/gallery/solids.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Meshes",
        text: "A knot of 2496 triangles from a PLY file, which has a normal and a color for each vertex. Since it \
               has no holes, it can be of glass.",
        pictures: &[
            Picture {
                name: "knot-flat",
                caption: "`normals: flat`",
                command: "render",
                scene: "scenes/gallery/knot-flat.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "knot-smooth",
                caption: "with the normals of the file",
                command: "render",
                scene: "scenes/gallery/knot-smooth.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "knot-glass",
                caption: "of glass",
                command: "render",
                scene: "scenes/gallery/knot-glass.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Models",
        text: "All of an OBJ file with the materials of its MTL file; the sea and the evening are of the scene.",
        pictures: &[Picture {
            name: "lighthouse",
            caption: "a red and white lighthouse and a small house on a rock, mirrored in the sea",
            command: "render",
            scene: "scenes/gallery/lighthouse.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Molecules and crystals",
        text: "Atoms from an .xyz file as balls, bonds from a table as cylinders; and bonds alone, as capsules.",
        pictures: &[
            Picture {
                name: "caffeine",
                caption: "caffeine",
                command: "render",
                scene: "scenes/gallery/caffeine.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "diamond",
                caption: "diamond",
                command: "render",
                scene: "scenes/gallery/diamond.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "A field of arrows",
        text: "The magnetic field of a current in a ring. Shafts, heads and colors of all arrows come from one \
               table of numbers.",
        pictures: &[Picture {
            name: "field",
            caption: "hundreds of arrows around a copper ring, red near it and blue far from it",
            command: "render",
            scene: "scenes/gallery/field.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Textures",
        text: "All eight: above checker, stripes, rings and gradient; below image, noise, marble and wood.",
        pictures: &[Picture {
            name: "textures",
            caption: "eight balls with different textures",
            command: "render",
            scene: "scenes/gallery/textures.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "An image on a shape",
        text: "A picture laid around a cylinder.",
        pictures: &[
            Picture {
                name: "texture-off",
                caption: "without",
                command: "render",
                scene: "scenes/gallery/texture-off.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "texture-on",
                caption: "with the image",
                command: "render",
                scene: "scenes/gallery/texture-on.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Transforms",
        text: "A ball is scaled to an ellipsoid, turned and moved; its texture goes with it.",
        pictures: &[
            Picture {
                name: "transform-before",
                caption: "before",
                command: "render",
                scene: "scenes/gallery/transform-before.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "transform-after",
                caption: "after scaling, turning and moving",
                command: "render",
                scene: "scenes/gallery/transform-after.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Groups",
        text: "A chair is built once and used four times; its parts take their material from the group, unless the \
               group has another.",
        pictures: &[Picture {
            name: "groups",
            caption: "a round table and four chairs, one of them red",
            command: "render",
            scene: "scenes/gallery/groups.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "A wood",
        text: "2800 firs in the mist, and the same view as a heatmap: the brighter a pixel, the more of the scene \
               was looked at to find what is there.",
        pictures: &[
            Picture {
                name: "wood",
                caption: "the wood",
                command: "render",
                scene: "scenes/gallery/wood.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "wood-heat",
                caption: "`durer heatmap`",
                command: "heatmap",
                scene: "scenes/gallery/wood.yaml",
                arguments: &[],
            },
        ],
    },
    Entry {
        heading: "Cameras",
        text: "Perspective and parallel projection.",
        pictures: &[
            Picture {
                name: "perspective",
                caption: "perspective",
                command: "render",
                scene: "scenes/gallery/perspective.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "orthographic",
                caption: "parallel projection",
                command: "render",
                scene: "scenes/gallery/orthographic.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Lights and shadows",
        text: "Every lamp throws shadows; where those of two lamps overlap it is dark.",
        pictures: &[
            Picture {
                name: "lights-one",
                caption: "one lamp",
                command: "render",
                scene: "scenes/gallery/lights-one.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "lights-two",
                caption: "two lamps",
                command: "render",
                scene: "scenes/gallery/lights-two.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Far and near lights",
        text: "The sun's shadows are parallel, those of a lamp point away from it.",
        pictures: &[
            Picture {
                name: "directional",
                caption: "directional light",
                command: "render",
                scene: "scenes/gallery/directional.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "point",
                caption: "a point light",
                command: "render",
                scene: "scenes/gallery/point.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "A spotlight",
        text: "A spotlight throws a round shadow of the middle ball on the back wall. Its edge is hard or soft.",
        pictures: &[
            Picture {
                name: "spot-off",
                caption: "off",
                command: "render",
                scene: "scenes/gallery/spot-off.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "spot-on",
                caption: "on",
                command: "render",
                scene: "scenes/gallery/spot-on.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "spot-soft",
                caption: "with a soft edge",
                command: "render",
                scene: "scenes/gallery/spot-soft.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Falloff",
        text: "Light that stays as strong as it is, as in classic ray tracing, and light that weakens with the \
               square of the distance, as light does.",
        pictures: &[
            Picture {
                name: "falloff-none",
                caption: "`falloff: none`",
                command: "render",
                scene: "scenes/gallery/falloff-none.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "falloff-inverse-square",
                caption: "`falloff: inverse_square`",
                command: "render",
                scene: "scenes/gallery/falloff-inverse-square.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "A mirror",
        text: "A plain sheet, and the same sheet reflecting 80 % of the light.",
        pictures: &[
            Picture {
                name: "mirror-off",
                caption: "off",
                command: "render",
                scene: "scenes/gallery/mirror-off.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "mirror-on",
                caption: "on",
                command: "render",
                scene: "scenes/gallery/mirror-on.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Depth of recursion",
        text: "Two mirrors face each other; a ray is followed as often as `max_depth` says.",
        pictures: &[
            Picture {
                name: "mirrors-2",
                caption: "depth 2",
                command: "render",
                scene: "scenes/gallery/mirrors.yaml",
                arguments: &["--max-depth", "2", "--antialias", "grid:4"],
            },
            Picture {
                name: "mirrors-5",
                caption: "depth 5",
                command: "render",
                scene: "scenes/gallery/mirrors.yaml",
                arguments: &["--max-depth", "5", "--antialias", "grid:4"],
            },
            Picture {
                name: "mirrors-20",
                caption: "depth 20",
                command: "render",
                scene: "scenes/gallery/mirrors.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Clear, refracting, glass",
        text: "A clear ball lets light go straight through; one with an index of refraction bends it; with \
               Fresnel's equations it mirrors, too, as glass does.",
        pictures: &[
            Picture {
                name: "clear",
                caption: "clear",
                command: "render",
                scene: "scenes/gallery/clear.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "refractive",
                caption: "refracting",
                command: "render",
                scene: "scenes/gallery/refractive.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "glass",
                caption: "glass",
                command: "render",
                scene: "scenes/gallery/glass.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Lenses",
        text: "What two balls have in common makes larger; what they leave of a disc makes smaller.",
        pictures: &[
            Picture {
                name: "lens-convex",
                caption: "an intersection",
                command: "render",
                scene: "scenes/gallery/lens-convex.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "lens-concave",
                caption: "a difference",
                command: "render",
                scene: "scenes/gallery/lens-concave.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Fresnel",
        text: "Water is clear where one looks down and a mirror where one looks along it.",
        pictures: &[
            Picture {
                name: "fresnel-off",
                caption: "without Fresnel's equations",
                command: "render",
                scene: "scenes/gallery/fresnel-off.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "fresnel-on",
                caption: "with them",
                command: "render",
                scene: "scenes/gallery/fresnel-on.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Colored glass",
        text: "Glass takes color from light with distance (Beer–Lambert), so one material makes all five slabs, and \
               their shadows.",
        pictures: &[Picture {
            name: "colored-glass",
            caption: "five slabs of green glass of rising thickness, and two ruby balls",
            command: "render",
            scene: "scenes/gallery/colored-glass.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Glass in glass",
        text: "A solid glass ball, one with a bubble of air, one with a denser ball inside. Media nest without \
               tricks at their boundaries.",
        pictures: &[Picture {
            name: "bubble",
            caption: "three glass balls before a striped wall",
            command: "render",
            scene: "scenes/gallery/bubble.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Under water",
        text: "A glass ball and a bubble of air in a tank of water; and the eye inside of a ball of glass.",
        pictures: &[
            Picture {
                name: "aquarium",
                caption: "glass and air in water",
                command: "render",
                scene: "scenes/gallery/aquarium.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "inside-glass",
                caption: "the eye in glass",
                command: "render",
                scene: "scenes/gallery/inside-glass.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "Total internal reflection",
        text: "Under water, looking up: beyond 48.6° from straight up nothing gets through, and the surface mirrors \
               the pool.",
        pictures: &[Picture {
            name: "total-reflection",
            caption: "a tiled pool from below the surface",
            command: "render",
            scene: "scenes/gallery/total-reflection.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Fog",
        text: "An avenue in clear air, in fog that thickens evenly, and in fog with a beginning and an end.",
        pictures: &[
            Picture {
                name: "fog-off",
                caption: "none",
                command: "render",
                scene: "scenes/gallery/fog-off.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "fog-exponential",
                caption: "exponential",
                command: "render",
                scene: "scenes/gallery/fog-exponential.yaml",
                arguments: &["--antialias", "grid:4"],
            },
            Picture {
                name: "fog-linear",
                caption: "linear",
                command: "render",
                scene: "scenes/gallery/fog-linear.yaml",
                arguments: &["--antialias", "grid:4"],
            },
        ],
    },
    Entry {
        heading: "A sky",
        text: "A background that goes from one color at the bottom to another at the top.",
        pictures: &[Picture {
            name: "sky",
            caption: "a mirroring ball under an evening sky",
            command: "render",
            scene: "scenes/gallery/sky.yaml",
            arguments: &["--antialias", "grid:4"],
        }],
    },
    Entry {
        heading: "Anti-aliasing",
        text: "One ray for each pixel leaves stairs on edges and breaks up fine patterns. A grid sends the same \
               number of rays everywhere, the recursive method more only where they differ.",
        pictures: &[
            Picture {
                name: "antialias-none",
                caption: "one ray a pixel",
                command: "render",
                scene: "scenes/gallery/antialias.yaml",
                arguments: &["--antialias", "none"],
            },
            Picture {
                name: "antialias-grid",
                caption: "a grid of 3 × 3",
                command: "render",
                scene: "scenes/gallery/antialias.yaml",
                arguments: &["--antialias", "grid:3"],
            },
            Picture {
                name: "antialias-recursive",
                caption: "recursive",
                command: "render",
                scene: "scenes/gallery/antialias.yaml",
                arguments: &["--antialias", "recursive:0.1,4"],
            },
        ],
    },
    Entry {
        heading: "Encoding",
        text: "Screens expect numbers encoded by the sRGB curve. The room's first version sent the linear numbers \
               to the screen as they were, which makes all but the brightest darker.",
        pictures: &[
            Picture {
                name: "room-srgb",
                caption: "`--transfer srgb`",
                command: "render",
                scene: "scenes/room.yaml",
                arguments: &["--width", "320", "--antialias", "grid:4"],
            },
            Picture {
                name: "room-linear",
                caption: "`--transfer linear`",
                command: "render",
                scene: "scenes/room.yaml",
                arguments: &["--width", "320", "--antialias", "grid:4", "--transfer", "linear"],
            },
        ],
    },
];
