//! Short constructors for what a description holds. What they leave out has its usual value, and every field is public.
//!
//! Places, directions and colours are whatever becomes a [`Vec3`]: one, or an array of three `f32`. Nothing is checked
//! here; [`check`](super::check) and [`compile`](super::compile()) do that.

use glam::{Vec2, Vec3};

use super::{
    CameraDescription, Cone, Cuboid, Cylinder, Description, Disc, Fractal, Light, Material, Mesh, Pigment, Plane, Quad,
    Sides, Sphere, Torus,
};
use crate::kinds::for_each_kind;

impl Description {
    /// Adds a material, and gives its index, by which primitives refer to it.
    pub fn add_material(&mut self, material: Material) -> usize {
        self.materials.push(material);
        self.materials.len() - 1
    }
}

impl CameraDescription {
    /// An eye that looks at a point, which is another one; +y is up and the vertical field of view 60°.
    pub fn new(eye: impl Into<Vec3>, look_at: impl Into<Vec3>) -> Self {
        Self { eye: eye.into(), look_at: look_at.into(), ..Self::default() }
    }
}

impl Light {
    /// A point light of a power in watts by colour channel.
    pub fn new(position: impl Into<Vec3>, power: impl Into<Vec3>) -> Self {
        Self { position: position.into(), power: power.into() }
    }
}

impl Material {
    /// A matt surface of a colour, each channel 0 or more; it reflects no more light than it gets where none is above
    /// 1.
    pub fn diffuse(color: impl Into<Vec3>) -> Self {
        Self { pigment: Pigment::Color(color.into()), ..Self::default() }
    }

    /// A mirror of the fraction `reflectance`, 0 to 1; what it does not reflect is a grey matt surface.
    pub fn mirror(reflectance: f32) -> Self {
        Self { reflectance, ..Self::default() }
    }

    /// A clear body of an index of refraction, 0.1 to 10: 1.5 for window glass, 1.33 for water. Its surface is closed,
    /// and its normals point outward.
    pub fn glass(ior: f32) -> Self {
        Self { transmission: 1.0, ior, ..Self::default() }
    }
}

impl Plane {
    /// The points p with p·normal + distance = 0.
    pub fn new(normal: impl Into<Vec3>, distance: f32) -> Self {
        Self { normal: normal.into(), distance, material: 0 }
    }
}

impl Sphere {
    /// A whole sphere.
    pub fn new(center: impl Into<Vec3>, radius: f32) -> Self {
        Self { center: center.into(), radius, sides: Sides::Both, material: 0 }
    }
}

impl Mesh {
    /// Triangles by their vertices' positions and three vertex indices each, which are copied.
    pub fn new<P: Copy + Into<Vec3>>(positions: &[P], triangles: &[[u32; 3]]) -> Self {
        let positions = positions.iter().map(|&p| p.into()).collect();
        Self { positions, triangles: triangles.to_vec(), ..Self::default() }
    }

    /// The same with a normal for every vertex, of any length but zero, which are copied; so it is shaded smoothly.
    #[must_use]
    pub fn with_normals<P: Copy + Into<Vec3>>(mut self, normals: &[P]) -> Self {
        self.normals = normals.iter().map(|&n| n.into()).collect();
        self
    }

    /// The same with texture coordinates for every vertex, which are copied.
    #[must_use]
    pub fn with_uvs<P: Copy + Into<Vec2>>(mut self, uvs: &[P]) -> Self {
        self.uvs = uvs.iter().map(|&uv| uv.into()).collect();
        self
    }
}

impl Quad {
    /// The parallelogram of the points corner + a u + b v, a and b from 0 to 1.
    pub fn new(corner: impl Into<Vec3>, u: impl Into<Vec3>, v: impl Into<Vec3>) -> Self {
        Self { corner: corner.into(), u: u.into(), v: v.into(), material: 0 }
    }
}

impl Cuboid {
    /// A box along the axes, by its corners with the least and the greatest coordinates.
    pub fn new(min: impl Into<Vec3>, max: impl Into<Vec3>) -> Self {
        Self { min: min.into(), max: max.into(), rotation: Vec3::ZERO, material: 0 }
    }
}

impl Cylinder {
    /// A closed cylinder.
    pub fn new(base: impl Into<Vec3>, apex: impl Into<Vec3>, radius: f32) -> Self {
        Self { base: base.into(), apex: apex.into(), radius, caps: true, sides: Sides::Both, material: 0 }
    }
}

impl Cone {
    /// A closed cone or frustum, by the radii at both ends.
    pub fn new(base: impl Into<Vec3>, base_radius: f32, apex: impl Into<Vec3>, apex_radius: f32) -> Self {
        let (base, apex) = (base.into(), apex.into());
        Self { base, base_radius, apex, apex_radius, caps: true, sides: Sides::Both, material: 0 }
    }
}

impl Torus {
    /// A ring about `center`, across `axis`.
    pub fn new(center: impl Into<Vec3>, axis: impl Into<Vec3>, major_radius: f32, minor_radius: f32) -> Self {
        Self { center: center.into(), axis: axis.into(), major_radius, minor_radius, material: 0 }
    }
}

impl Fractal {
    /// A Menger sponge within the cube of the edge 2 · `radius`.
    pub fn new(center: impl Into<Vec3>, radius: f32, iterations: u32) -> Self {
        Self { center: center.into(), radius, iterations, material: 0 }
    }
}

impl Disc {
    /// A disc without a hole.
    pub fn new(center: impl Into<Vec3>, normal: impl Into<Vec3>, radius: f32) -> Self {
        Self { center: center.into(), normal: normal.into(), radius, inner_radius: 0.0, material: 0 }
    }
}

macro_rules! with_material {
    ($($group:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
        $($(impl $Kind {
            /// The same, of the material with this index ([`Description::materials`]); without, it is material 0.
            #[must_use]
            pub fn with_material(mut self, material: usize) -> Self {
                self.material = material;
                self
            }
        })*)*
    };
}
for_each_kind!(with_material);
