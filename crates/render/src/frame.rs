//! Orthonormal frames: scattering is computed where the normal is the z axis.

use durer_math::{DVec3, any_orthonormal_pair, functions::cos_sin_of_turns};

/// A right-handed orthonormal frame around a shading normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    x: DVec3,
    y: DVec3,
    z: DVec3,
}

impl Frame {
    /// One whose z axis is this unit vector.
    pub(crate) fn around(z: DVec3) -> Frame {
        let (x, y) = any_orthonormal_pair(z);
        Frame { x, y, z }
    }

    /// One whose z axis is this unit vector, and whose x axis is as near to a tangent as can be; any if that is along z.
    pub(crate) fn along(z: DVec3, tangent: DVec3) -> Frame {
        match (tangent - z * tangent.dot(z)).try_normalize() {
            Some(x) => Frame { x, y: z.cross(x), z },
            None => Frame::around(z),
        }
    }

    /// The same, turned about its z axis: so many turns, counterclockwise seen from its tip.
    pub(crate) fn turned(self, turns: f64) -> Frame {
        let (cos, sin) = cos_sin_of_turns(turns - turns.floor());
        Frame { x: self.x * cos + self.y * sin, y: self.y * cos - self.x * sin, z: self.z }
    }

    /// From the world to the frame.
    pub(crate) fn to_local(self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.z))
    }

    /// From the frame to the world.
    pub(crate) fn to_world(self, v: DVec3) -> DVec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}
