// The seed's room for POV-Ray 3.7: the same numbers as scenes/room.yaml. Rendered by `cargo xtask bench peers`,
// with +Lscenes/textures for the image.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 5 }

// direction -z with right +x: the scene's right-handed coordinates are kept.
camera {
  perspective location <0,0,0> direction <0,0,-1>
  right x*1.6*image_width/image_height up y*1.6
}

light_source { <20,23,15>, rgb 0.5 }
light_source { <-20,23,15>, rgb 0.5 }
light_source { <0,5,-5>, rgb 0.5 spotlight point_at <0,-15,-40> radius 15 falloff 15 tightness 0 }

#ifndef (NoFog)
fog { fog_type 1 distance 400 rgb <0.75,0.75,0.8> }
#end

#declare Matte = finish { ambient 0.2 diffuse 0.8 }
#declare Shiny = finish { ambient 0.2 diffuse 0.8 phong 0.6 phong_size 40 }

// hollow, here and on the clear spheres: the eye is inside the planes, and POV-Ray draws no fog inside solid things
plane { x, -30 pigment { rgb <0.8,0.2,0.2> } finish { Matte } hollow }
plane { x,  30 pigment { rgb <0.2,0.7,0.2> } finish { Matte } hollow }
plane { y, -25 pigment { rgb <0.5,0.5,0.5> } finish { Matte } hollow }
plane { y,  25 pigment { rgb <0.8,0.8,0.75> } finish { Matte } hollow }
plane { z, -70 pigment { rgb <0.2,0.3,0.8> } finish { Matte } hollow }
plane { z,  20 pigment { rgb <0.7,0.3,0.7> } finish { Matte } hollow }

// table: the pattern is three-dimensional; at y = -15 its y cell is floor(-3.75) = -4, even, so (x,z) decides
polygon { 5, <-20,-28>, <20,-28>, <20,-56>, <-20,-56>, <-20,-28>
  rotate 90*x translate -15*y
  pigment { checker rgb 0.95, rgb 0.05 scale 4 }
  finish { Matte } }

// mirror
polygon { 5, <-14,-6,-69>, <14,-6,-69>, <14,14,-66>, <-14,14,-66>, <-14,-6,-69>
  pigment { rgb 0.1 } finish { ambient 0.2 diffuse 0.8 reflection { 0.8 } } }

sphere { <-9,-10,-38>, 5 pigment { rgbt <0.9,0.4,0.4,0.7> } finish { Shiny } hollow }
sphere { <0,-10,-42>, 5 pigment { rgbt <0.6,0.8,0.9,0.8> } finish { Shiny } interior { ior 1.5 } hollow }
sphere { <0,0,0>, 3 scale <1.3,0.8,1.0> rotate 15*y translate <8.5,-4.6,-47>
  pigment { rgb <0.9,0.8,0.1> } finish { Shiny } }

// cylinder 1: POV-Ray's cylindrical map covers y 0..1 of the local frame; u runs the same way round up to a shift
union {
  cylinder { <0,0,0>, <0,1,0>, 1 open
    pigment { image_map { png "seed.png" map_type 2 interpolate 2 } } finish { Shiny }
    scale <2.5,16,2.5> translate <-12,-25,-23> }
  disc { <-12,-9,-23>, y, 2.5 pigment { rgb 0.6 } finish { Shiny } }
  disc { <-12,-25,-23>, -y, 2.5 pigment { rgb 0.6 } finish { Shiny } }
}
cylinder { <8.5,-15,-47>, <8.5,-7,-47>, 3 pigment { rgb <0.1,0.6,0.2> } finish { Shiny } }
cone { <3,-15,-32>, 2, <3,-10,-32>, 0 pigment { rgb <0.9,0.5,0.1> } finish { Shiny } }
cone { <-12,-15,-50>, 4, <-12,-2,-50>, 0 pigment { rgb <0.1,0.7,0.1> } finish { Shiny } }
