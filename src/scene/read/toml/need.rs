//! What parsing a text takes, so that it can be asked for as a whole: the parser cannot say that it got too little.

/// An estimate of the bytes, counted in what the parser (`toml` 1.2) keeps: 24 for a token and as many for what it means,
/// with room to grow by for the former; some for each value; and a node of its own for each table, however short, of which
/// so many are in braces or before dots.
pub(super) fn bytes(text: &str, tables: usize) -> usize {
    let (mut tokens, mut values, mut arrays, mut headers) = (0, 0, 0, 1);
    let (mut last, mut line_starts) = (Part::Break, true);
    for byte in text.bytes() {
        let part = match byte {
            b' ' | b'\t' | b'\r' => Part::Blank,
            b'[' | b']' | b'{' | b'}' | b',' | b'=' | b'.' | b'\n' => Part::Break,
            _ => Part::Word,
        };
        tokens += usize::from(part != last || part == Part::Break);
        arrays += usize::from(byte == b'[');
        headers += usize::from(byte == b'[' && line_starts);
        line_starts = byte == b'\n';
        values += usize::from(byte == b',');
        last = part;
    }
    let mut capacity = (text.len() / 7 * 2).max(4);
    while capacity < tokens {
        capacity *= 2;
    }
    text.len() + 24 * (capacity + tokens) + 84 * values + 224 * arrays + 1200 * (tables + headers)
}

/// What a byte belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Blank,
    Word,
    Break,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked out by hand from what a table and its parts take.
    #[test]
    fn spheres_take_what_they_are_seen_to_take() {
        // 1,154 MB of address space for 460,000 of them, of which 16 tokens, a table and an array each.
        let spheres = "sphere=[".to_owned() + &"{center=[0,0,0],radius=1},".repeat(460_000) + "]";
        let estimate = bytes(&spheres, 460_000) as f64;
        assert!((1.154e9..1.35e9).contains(&estimate), "{estimate}");
        assert!(bytes("", 0) < 2000);
    }
}
