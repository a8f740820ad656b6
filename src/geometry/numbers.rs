//! The numbers of a primitive, for any type of number: one (`f32`), lanes, or a block's columns (`[f32; 8]`).

/// Structs over a type of number `T`, with fields of the forms `T`, `[T; 2]`, `[T; 3]`, `Vec3`, `[Vec3; 2]`,
/// `[Vec3; 3]` and `[[T; 3]; 3]`.
///
/// `zip` makes a third of two, number by number, and `map` another of one. Arrays are spelled out, as the library's own
/// map is a call where numbers are wide.
macro_rules! numbers {
    ($($(#[$doc:meta])* $name:ident { $($(#[$about:meta])* $field:ident: $form:tt,)+ })+) => {$(
        $(#[$doc])*
        pub struct $name<T> {
            $($(#[$about])* pub $field: crate::geometry::numbers::form!($form T),)+
        }

        impl<T: Copy> Clone for $name<T> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<T: Copy> Copy for $name<T> {}

        impl<T: PartialEq> PartialEq for $name<T> {
            fn eq(&self, other: &Self) -> bool {
                true $(&& self.$field == other.$field)+
            }
        }

        impl<T: std::fmt::Debug> std::fmt::Debug for $name<T> {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.debug_struct(stringify!($name))$(.field(stringify!($field), &self.$field))+.finish()
            }
        }

        impl<T: Copy> $name<T> {
            /// Number by number, from this and another.
            #[inline(always)]
            pub fn zip<U: Copy, V: Copy>(&self, other: &$name<U>, f: impl Fn(&T, &U) -> V) -> $name<V> {
                $name { $($field: crate::geometry::numbers::zip!($form, self.$field, other.$field, f),)+ }
            }

            /// Number by number.
            #[inline(always)]
            pub fn map<V: Copy>(&self, f: impl Fn(&T) -> V) -> $name<V> {
                self.zip(self, |a, _| f(a))
            }
        }
    )+};
}

/// The type of a form.
macro_rules! form {
    (T $t:ident) => { $t };
    ([T; 2] $t:ident) => { [$t; 2] };
    ([T; 3] $t:ident) => { [$t; 3] };
    (Vec3 $t:ident) => { crate::math::Vec3<$t> };
    ([Vec3; 2] $t:ident) => { [crate::math::Vec3<$t>; 2] };
    ([Vec3; 3] $t:ident) => { [crate::math::Vec3<$t>; 3] };
    ([[T; 3]; 3] $t:ident) => { [[$t; 3]; 3] };
}

/// Two of a form, number by number.
macro_rules! zip {
    (T, $a:expr, $b:expr, $f:ident) => {
        $f(&$a, &$b)
    };
    ([T; 2], $a:expr, $b:expr, $f:ident) => {
        [$f(&$a[0], &$b[0]), $f(&$a[1], &$b[1])]
    };
    ([T; 3], $a:expr, $b:expr, $f:ident) => {
        [$f(&$a[0], &$b[0]), $f(&$a[1], &$b[1]), $f(&$a[2], &$b[2])]
    };
    (Vec3, $a:expr, $b:expr, $f:ident) => {
        crate::math::Vec3 { x: $f(&$a.x, &$b.x), y: $f(&$a.y, &$b.y), z: $f(&$a.z, &$b.z) }
    };
    ([Vec3; 2], $a:expr, $b:expr, $f:ident) => {
        [crate::geometry::numbers::zip!(Vec3, $a[0], $b[0], $f), crate::geometry::numbers::zip!(Vec3, $a[1], $b[1], $f)]
    };
    ([Vec3; 3], $a:expr, $b:expr, $f:ident) => {
        [
            crate::geometry::numbers::zip!(Vec3, $a[0], $b[0], $f),
            crate::geometry::numbers::zip!(Vec3, $a[1], $b[1], $f),
            crate::geometry::numbers::zip!(Vec3, $a[2], $b[2], $f),
        ]
    };
    ([[T; 3]; 3], $a:expr, $b:expr, $f:ident) => {
        [
            crate::geometry::numbers::zip!([T; 3], $a[0], $b[0], $f),
            crate::geometry::numbers::zip!([T; 3], $a[1], $b[1], $f),
            crate::geometry::numbers::zip!([T; 3], $a[2], $b[2], $f),
        ]
    };
}
pub(crate) use {form, numbers, zip};
