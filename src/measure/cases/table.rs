//! All cases, by name.

use super::Spacing::Logarithmic;
use super::{Dial, Generator, Made, Pcg, Subject};
use super::{axial, cuboid, fractal, glass, leaving, light, mesh, mixed, plane, sphere, torus, triangle};

/// An entry; all dials are logarithmic, and a setting is what `meaning` says in `unit`.
const fn entry(
    name: &'static str,
    subject: Subject,
    make: fn(f64, usize, &mut Pcg) -> Made,
    about: &'static str,
    (meaning, unit, least, most): (&'static str, &'static str, f64, f64),
) -> Generator {
    Generator { name, about, dial: Dial { meaning, unit, least, most, spacing: Logarithmic }, subject, make }
}

/// A dial that scales a thing whose surface rays leave.
const SIZE: (&str, &str, f64, f64) = ("size of the primitive", "world units", 1e-8, 1e8);

/// A dial for the angle to an axis.
const TO_AXIS: (&str, &str, f64, f64) = ("angle between ray and axis", "degrees", 1e-7, 90.0);

/// A dial for the angle to an axis that is not exact in `f32`: next to it directions are no denser.
const TO_TILTED_AXIS: (&str, &str, f64, f64) = ("angle between ray and axis", "degrees", 1e-5, 90.0);

/// A dial for how near a torus's tangents are.
const CLEARANCE: (&str, &str, f64, f64) = ("distance from the tangent", "minor radii", 1e-8, 0.5);

/// The description of the cases `…-leaving`.
const LEAVING: &str = "Rays that start at the f32 point nearest to an exact one of the surface, half to each side.";

/// Every case.
pub const ALL: &[Generator] = &[
    entry(
        "sphere-far",
        Subject::Sphere,
        sphere::far,
        "A sphere near the world's origin, seen from afar; rays as rounded pass its centre by up to 1.1 radii.",
        ("distance to the sphere", "radii", 1.0, 1e7),
    ),
    entry(
        "sphere-close",
        Subject::Sphere,
        sphere::close,
        "A planet below an eye near the world's origin; three of four rays go below the exact horizon, one above.",
        ("radius", "heights of the eye", 1.0, 1e7),
    ),
    entry(
        "sphere-tangent",
        Subject::Sphere,
        sphere::tangent,
        "Rays as rounded pass the silhouette at the exact distance, inside and outside in turn.",
        ("distance from the silhouette", "radii", 1e-8, 1.0),
    ),
    entry(
        "sphere-inside",
        Subject::Sphere,
        sphere::inside,
        "Rays in all directions from inside, at the exact depth below the surface.",
        ("depth below the surface", "radii", 1e-7, 1.0),
    ),
    entry("plane-leaving", Subject::Plane, leaving::plane, LEAVING, SIZE),
    entry("sphere-leaving", Subject::Sphere, leaving::sphere, LEAVING, SIZE),
    entry("triangle-leaving", Subject::Triangle, leaving::triangle, LEAVING, SIZE),
    entry("quad-leaving", Subject::Quad, leaving::quad, LEAVING, SIZE),
    entry("box-leaving", Subject::Cuboid, leaving::cuboid, LEAVING, SIZE),
    entry("cylinder-leaving", Subject::Cylinder, leaving::cylinder, LEAVING, SIZE),
    entry("cone-leaving", Subject::Cone, leaving::cone, LEAVING, SIZE),
    entry("torus-leaving", Subject::Torus, leaving::torus, LEAVING, SIZE),
    entry("disc-leaving", Subject::Disc, leaving::disc, LEAVING, SIZE),
    entry(
        "plane-grazing",
        Subject::Plane,
        plane::grazing,
        "Rays as rounded at the exact angle to a plane, towards it and away from it in turn.",
        ("angle between ray and plane", "degrees", 1e-7, 90.0),
    ),
    entry(
        "triangle-edge",
        Subject::Triangle,
        triangle::edge,
        "A ridge of two triangles; rays as rounded pass the shared edge at the exact distance, on either side in turn, \
         and all hit.",
        ("distance from the edge", "edge lengths", 1e-9, 0.1),
    ),
    entry(
        "triangle-vertex",
        Subject::Triangle,
        triangle::vertex,
        "A fan of triangles; rays as rounded pass its vertex at the exact distance, and all hit.",
        ("distance from the vertex", "edge lengths", 1e-8, 0.1),
    ),
    entry(
        "triangle-sliver",
        Subject::Triangle,
        triangle::sliver,
        "One triangle as thin as said, its corners as rounded; rays hit and miss it exactly in turn, by less than its \
         height.",
        ("height of the triangle", "base lengths", 1e-7, 1.0),
    ),
    entry(
        "mesh-moved",
        Subject::Triangle,
        mesh::moved,
        "A closed mesh of radius 1 with the eye 3 to 5 from it, away from the world's origin together. Vertices are \
         rounded; rays go to points of the rounded triangles.",
        ("distance from the world's origin", "radii of the mesh", 1.0, 1e7),
    ),
    entry(
        "mesh-far",
        Subject::Triangle,
        mesh::far,
        "The same mesh near the world's origin, seen from afar; rays as rounded pass its centre by up to 1.1 radii.",
        ("distance to the mesh", "radii of the mesh", 1.0, 1e7),
    ),
    entry(
        "torus-outer-equator",
        Subject::Torus,
        torus::outer,
        "Rays as rounded along tangents of the outer equator, at the exact distance from the point of contact, inside \
         and outside in turn.",
        CLEARANCE,
    ),
    entry(
        "torus-inner-equator",
        Subject::Torus,
        torus::inner,
        "The same at the inner equator, from 0.1 to 0.6 major radii away.",
        CLEARANCE,
    ),
    entry(
        "torus-top-circle",
        Subject::Torus,
        torus::top,
        "The same at the circles where a plane across the axis touches the torus.",
        CLEARANCE,
    ),
    entry(
        "cylinder-axis",
        Subject::Cylinder,
        axial::cylinder,
        "An open cylinder exactly along a world axis; rays through its side at the exact angle, half of them with a \
         component that is 0 or −0.",
        TO_AXIS,
    ),
    entry(
        "cylinder-axis-tilted",
        Subject::Cylinder,
        axial::tilted_cylinder,
        "The same along no world axis; the angle is to the line through the rounded ends.",
        TO_TILTED_AXIS,
    ),
    entry("cone-axis", Subject::Cone, axial::cone, "As cylinder-axis, for an open cone of slope 0.1.", TO_AXIS),
    entry(
        "cone-axis-tilted",
        Subject::Cone,
        axial::tilted_cone,
        "As cylinder-axis-tilted, for an open cone of slope 0.1.",
        TO_TILTED_AXIS,
    ),
    entry(
        "cone-side",
        Subject::Cone,
        axial::along_side,
        "Rays as steep to a cone's axis as its side, but for exactly the angle said, through points of the side.",
        ("difference from the side's steepness", "degrees", 1e-7, 5.0),
    ),
    entry(
        "box-face",
        Subject::Cuboid,
        cuboid::in_face,
        "Rays along a face, exactly in its plane, outside and inside in turn, with directions of 0 and −0 across it.",
        ("distance from the face's plane", "steps of f32", 1.0, 1e6),
    ),
    entry(
        "fractal-surface",
        Subject::Fractal,
        fractal::surface,
        "Rays in all directions from the exact distance off a face, in the void and in the material in turn.",
        ("distance from the surface", "widths of the finest holes", 1e-5, 0.4),
    ),
    entry(
        "refraction-critical",
        Subject::Refraction,
        glass::critical,
        "From within glass, at the exact angle from the critical one of ior 1.5: steeper, which passes, and flatter, \
         which is reflected totally, in turn.",
        ("angle from the critical angle", "degrees", 1e-7, 40.0),
    ),
    entry(
        "refraction-shell",
        Subject::Refraction,
        glass::shell,
        "A bubble of glass; rays through both its surfaces, and through the rim alone, in turn. The inner radius is \
         rounded.",
        ("thickness of the glass", "radii", 1e-6, 0.5),
    ),
    entry(
        "refraction-gap",
        Subject::Refraction,
        glass::gap,
        "Two blocks of glass with air between them, exactly as wide as said, in f32; rays through both.",
        ("width of the gap", "widths of a block", 1e-8, 1.0),
    ),
    entry(
        "light-plane",
        Subject::Shadow,
        light::plane,
        "A light exactly as high over a plane as said, in f32; rays from it that end on the plane, to within rounding.",
        ("height of the light", "world units", 1e-8, 1.0),
    ),
    entry(
        "light-sphere",
        Subject::Shadow,
        light::sphere,
        "A light at the exact height over a sphere; rays from it that end on the side of the sphere that faces it, to \
         within rounding.",
        ("height of the light", "radii", 1e-7, 1.0),
    ),
    entry(
        "scene-scaled",
        Subject::All,
        mixed::scaled,
        "One primitive of every kind, all rounded after scaling; rays from 12 scales away to within 4 of the middle.",
        ("scale", "times", 1e-6, 1e6),
    ),
    entry(
        "scene-moved",
        Subject::All,
        mixed::moved,
        "The same scene at its own size, rounded after moving it.",
        ("distance from the world's origin", "world units", 1e-6, 1e6),
    ),
];
