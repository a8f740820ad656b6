//! The kinds of primitive, stated once, in the order of their ids.
//!
//! Whatever is done kind by kind is made from this list: `for_each_kind!(callback)` expands to
//! `callback! { unbounded { … } bounded { … } }` with a row a kind:
//!
//! `(storage field: storage type, description field: description type, module)`
//!
//! The module is the kind's file in every folder that has a file a kind.

/// See the module's text. What follows the callback's name is handed on before the rows.
macro_rules! for_each_kind {
    ($callback:ident $($context:tt)*) => {
        $callback! {
            $($context)*
            unbounded {
                (planes: Planes, planes: Plane, plane)
            }
            bounded {
                (spheres: Spheres, spheres: Sphere, sphere)
                (triangles: Triangles, meshes: Mesh, triangle)
                (quads: Quads, quads: Quad, quad)
                (cuboids: Cuboids, cuboids: Cuboid, cuboid)
                (cylinders: Cylinders, cylinders: Cylinder, cylinder)
                (cones: Cones, cones: Cone, cone)
                (tori: Tori, tori: Torus, torus)
                (fractals: Fractals, fractals: Fractal, fractal)
                (discs: Discs, discs: Disc, disc)
            }
        }
    };
}
pub(crate) use for_each_kind;
