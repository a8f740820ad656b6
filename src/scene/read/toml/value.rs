//! The values of a scene file, and faults in them.
//!
//! Every value is read from one type, that of the parser, so that each reader is compiled once.

use std::{collections::BTreeMap, fmt, ops::Range};

use glam::{Vec2, Vec3};
use toml::Spanned;
use toml::de::{DeArray, DeFloat, DeInteger, DeTable, DeValue};

/// A key of an element, and the problem with it.
pub(crate) struct Fault(pub &'static str, pub String);

/// A value as it was parsed, and where in the text it stands.
pub(crate) type Parsed<'i> = Spanned<DeValue<'i>>;

/// What is wrong at a place of the text.
#[derive(Debug)]
pub(crate) struct Misfit {
    /// The place.
    pub span: Range<usize>,
    /// A key that is missing there.
    pub missing: Option<&'static str>,
    /// The problem.
    pub problem: String,
}

impl Misfit {
    fn new(span: Range<usize>, problem: String) -> Self {
        Self { span, missing: None, problem }
    }

    /// A key that no table of this kind has.
    pub fn unknown(key: Range<usize>, known: &[&str]) -> Self {
        let known = match known {
            [one] => format!("`{one}`"),
            [one, other] => format!("`{one}` or `{other}`"),
            all => format!("one of `{}`", all.join("`, `")),
        };
        Self::new(key, format!("unknown key, expected {known}"))
    }

    /// A value that is none of what is expected.
    fn kind(span: Range<usize>, value: &DeValue<'_>, expected: impl fmt::Display) -> Self {
        let found = match value {
            DeValue::String(text) => format!("string {text:?}"),
            DeValue::Boolean(is) => format!("boolean `{is}`"),
            DeValue::Integer(number) => {
                match whole(number).map(|number| format!("integer `{number}`")).or_else(|| long(number)) {
                    Some(found) => found,
                    None => return Self::new(span, "integer number overflowed".into()),
                }
            }
            DeValue::Float(number) => match float(number) {
                Some(number) => format!("floating point `{}`", decimal(number)),
                None => return Self::new(span, "floating-point number overflowed".into()),
            },
            DeValue::Array(_) => "sequence".into(),
            DeValue::Datetime(_) => "date".into(),
            DeValue::Table(_) => "map".into(),
        };
        Self::new(span, format!("invalid type: {found}, expected {expected}"))
    }
}

/// An integer of at most 64 bits.
fn whole(number: &DeInteger<'_>) -> Option<i128> {
    let (text, radix) = (number.as_str(), number.radix());
    let signed = i64::from_str_radix(text, radix).map(i128::from);
    signed.or_else(|_| u64::from_str_radix(text, radix).map(i128::from)).ok()
}

/// What messages call an integer of at most 128 bits.
fn long(number: &DeInteger<'_>) -> Option<String> {
    let (text, radix) = (number.as_str(), number.radix());
    let signed = i128::from_str_radix(text, radix).map(|number| format!("integer `{number}` as i128"));
    signed.or_else(|_| u128::from_str_radix(text, radix).map(|number| format!("integer `{number}` as u128"))).ok()
}

/// A number that is only infinite where the text says so.
fn float(number: &DeFloat<'_>) -> Option<f64> {
    let value: f64 = number.as_str().parse().ok()?;
    (value.is_finite() || value.is_nan() || number.as_str().contains("inf")).then_some(value)
}

/// A number as text that tells it from an integer.
fn decimal(number: f64) -> String {
    let text = number.to_string();
    if number.is_finite() && !text.contains('.') { text + ".0" } else { text }
}

/// What a key of a scene file holds.
pub(crate) trait Value: Sized {
    /// Reads it.
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit>;

    /// What it is where the key is left out; nothing where that is a fault.
    fn absent() -> Option<Self> {
        None
    }
}

impl Value for f32 {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        let number = match parsed.get_ref() {
            DeValue::Float(number) => float(number).map(|x| x as f32),
            DeValue::Integer(number) => whole(number).map(|x| x as f32),
            _ => None,
        };
        number.ok_or_else(|| Misfit::kind(parsed.span(), parsed.get_ref(), "a number"))
    }
}

impl Value for u32 {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        let number = match parsed.get_ref() {
            DeValue::Integer(number) => whole(number),
            _ => None,
        };
        let number = number.ok_or_else(|| Misfit::kind(parsed.span(), parsed.get_ref(), "a whole number"))?;
        let problem = || format!("invalid value: integer `{number}`, expected a whole number");
        number.try_into().map_err(|_| Misfit::new(parsed.span(), problem()))
    }
}

impl Value for bool {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        match parsed.get_ref() {
            DeValue::Boolean(is) => Ok(*is),
            other => Err(Misfit::kind(parsed.span(), other, "a boolean")),
        }
    }
}

impl Value for String {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        match parsed.get_ref() {
            DeValue::String(text) => Ok(text.as_ref().into()),
            other => Err(Misfit::kind(parsed.span(), other, "a string")),
        }
    }
}

impl Value for Vec3 {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        <[f32; 3]>::read(parsed).map(Vec3::from)
    }
}

impl Value for Vec2 {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        <[f32; 2]>::read(parsed).map(Vec2::from)
    }
}

impl<T: Value> Value for Option<T> {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        T::read(parsed).map(Some)
    }
    fn absent() -> Option<Self> {
        Some(None)
    }
}

/// An array of exactly `N`.
impl<T: Value, const N: usize> Value for [T; N] {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        let span = parsed.span();
        let all: Vec<T> = elements(parsed, &format_args!("an array of {N}"))?;
        let problem = |all: Vec<T>| format!("invalid length {}, expected an array of {N}", all.len());
        all.try_into().map_err(|all| Misfit::new(span, problem(all)))
    }
}

impl<T: Value> Value for Vec<T> {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        elements(parsed, &"an array")
    }
}

impl<T: Value> Value for BTreeMap<String, T> {
    fn read(parsed: Parsed<'_>) -> Result<Self, Misfit> {
        let entries = table_of(parsed)?.into_iter();
        entries.map(|(key, value)| Ok((key.into_inner().into_owned(), T::read(value)?))).collect()
    }
}

/// The elements of an array.
fn elements<T: Value>(parsed: Parsed<'_>, expected: &dyn fmt::Display) -> Result<Vec<T>, Misfit> {
    let array = array_of(parsed, expected)?;
    let mut all = Vec::with_capacity(array.len());
    for element in array {
        all.push(T::read(element)?);
    }
    Ok(all)
}

fn array_of<'i>(parsed: Parsed<'i>, expected: &dyn fmt::Display) -> Result<DeArray<'i>, Misfit> {
    let span = parsed.span();
    match parsed.into_inner() {
        DeValue::Array(array) => Ok(array),
        other => Err(Misfit::kind(span, &other, expected)),
    }
}

/// The entries of a table, which come sorted by their keys.
pub(crate) fn table_of(parsed: Parsed<'_>) -> Result<DeTable<'_>, Misfit> {
    let span = parsed.span();
    match parsed.into_inner() {
        DeValue::Table(table) => Ok(table),
        other => Err(Misfit::kind(span, &other, "a table")),
    }
}

/// The value of a key, or what it is where it is left out of the table at `span`.
pub(crate) fn field<T: Value>(value: Option<T>, span: &Range<usize>, key: &'static str) -> Result<T, Misfit> {
    let missing = || Misfit { span: span.clone(), missing: Some(key), problem: "missing".into() };
    value.or_else(T::absent).ok_or_else(missing)
}

/// Makes a struct that is read from a table of the same keys and no others: `key: Type`, or `key: Type = default`.
macro_rules! table {
    ($(#[$text:meta])* $visibility:vis struct $Name:ident { $($field:ident: $Type:ty $(= $default:expr)?,)* }) => {
        $(#[$text])*
        $visibility struct $Name {
            $($field: $Type,)*
        }

        impl $crate::scene::read::toml::value::Value for $Name {
            fn read(
                parsed: $crate::scene::read::toml::value::Parsed<'_>,
            ) -> Result<Self, $crate::scene::read::toml::value::Misfit> {
                use $crate::scene::read::toml::value::{Misfit, Value, field, table_of};
                let span = parsed.span();
                $(let mut $field: Option<$Type> = None;)*
                for (key, value) in table_of(parsed)? {
                    match key.get_ref().as_ref() {
                        $(stringify!($field) => $field = Some(Value::read(value)?),)*
                        _ => return Err(Misfit::unknown(key.span(), &[$(stringify!($field)),*])),
                    }
                }
                Ok(Self { $($field: field($field$(.or_else(|| Some($default)))?, &span, stringify!($field))?,)* })
            }
        }
    };
}
pub(in crate::scene) use table;
