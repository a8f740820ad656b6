//! Where in the TOML text a key stands, and which key stands at a place.
//!
//! Only asked once something is wrong, so that reading itself needs no spans.

use std::{fmt::Write, ops::Range};

use toml::de::{DeTable, DeValue};

use crate::scene::rules::key_part;

/// The line, from 1, that holds the byte at `offset`.
pub(super) fn line_at(text: &[u8], offset: usize) -> usize {
    1 + text[..offset.min(text.len())].iter().filter(|b| **b == b'\n').count()
}

/// The line, from 1, at `offset`, and what stands there before an equals sign: the key, as far as it can be told.
pub(super) fn quote(text: &[u8], offset: usize) -> (usize, String) {
    let offset = offset.min(text.len());
    let start = text[..offset].iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
    let line = text[start..].split(|b| *b == b'\n').next().unwrap_or_default();
    let key = line.split(|b| *b == b'=').next().unwrap_or_default();
    let key = String::from_utf8_lossy(&key[..key.len().min(120)]).trim().to_owned();
    (line_at(text, offset), if key.is_empty() { "end of line".into() } else { key })
}

/// The line of a key, or of the nearest table around it that the text spells out.
pub(super) fn line_of(text: &str, key: &str) -> usize {
    let mut best = (0, 0);
    walk(text, |at, key_span, _| {
        let around = key.strip_prefix(at).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']));
        if around && at.len() > best.0 {
            best = (at.len(), key_span.start);
        }
    });
    line_at(text.as_bytes(), best.1)
}

/// The key whose name or value stands at a span: the innermost one.
pub(super) fn key_at(text: &str, span: &Range<usize>) -> Option<String> {
    let mut best: Option<(usize, String)> = None;
    walk(text, |at, key_span, value_span| {
        for around in [key_span, value_span] {
            let holds = around.start <= span.start && span.end <= around.end;
            if holds && best.as_ref().is_none_or(|(len, _)| around.len() <= *len) {
                best = Some((around.len(), at.to_owned()));
            }
        }
    });
    best.map(|(_, key)| key)
}

/// Visits every key of the text with the span of its name and of its value; an element of an array has only a value.
fn walk(text: &str, mut visit: impl FnMut(&str, &Range<usize>, &Range<usize>)) {
    let (table, _) = DeTable::parse_recoverable(text);
    walk_table(table.get_ref(), &mut String::new(), &mut visit);
}

type Visit<'a> = &'a mut dyn FnMut(&str, &Range<usize>, &Range<usize>);

fn walk_table(table: &DeTable<'_>, path: &mut String, visit: Visit<'_>) {
    let end = path.len();
    for (name, value) in table {
        if end > 0 {
            path.push('.');
        }
        path.push_str(&key_part(name.get_ref()));
        // An array of tables is spelled by its elements' headers; the array itself has no line of its own.
        visit(path, &name.span(), &value.span());
        walk_value(value.get_ref(), path, visit);
        path.truncate(end);
    }
}

fn walk_value(value: &DeValue<'_>, path: &mut String, visit: Visit<'_>) {
    match value {
        DeValue::Table(table) => walk_table(table, path, visit),
        DeValue::Array(array) => {
            let end = path.len();
            for (i, element) in array.iter().enumerate() {
                let _ = write!(path, "[{i}]");
                visit(path, &element.span(), &element.span());
                walk_value(element.get_ref(), path, visit);
                path.truncate(end);
            }
        }
        _ => {}
    }
}
