//! The kind of a mesh file by its content.

/// A kind of mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Content {
    pub name: &'static str,
    pub extension: &'static str,
}

impl Content {
    /// By the first bytes, and of binary STL by the size.
    pub(super) fn of(bytes: &[u8]) -> Option<Self> {
        let begins = |with: &[u8]| {
            bytes
                .strip_prefix(with)
                .is_some_and(|rest| rest.starts_with(b"\n") || rest.starts_with(b"\r"))
        };
        let head = bytes.get(..bytes.len().min(1000)).unwrap_or_default();
        let holds = |word: &[u8]| head.windows(word.len()).any(|at| at == word);
        // After a header of 80 bytes, the number of triangles of 50 bytes each.
        let triangles = bytes.get(80..84).and_then(|count| count.try_into().ok());
        let stl_bytes = triangles.map(|count| 84 + 50 * u64::from(u32::from_le_bytes(count)));
        let (name, extension) = if begins(b"ply") {
            ("PLY", "ply")
        } else if bytes.starts_with(b"glTF") {
            // Read under the name of the text form too.
            ("GLB", "glb")
        } else if bytes.starts_with(b"PK\x03\x04") {
            ("3MF", "3mf")
        } else if holds(b"<COLLADA") {
            ("COLLADA", "dae")
        } else if begins(b"OFF") || begins(b"COFF") || begins(b"NOFF") {
            ("OFF", "off")
        } else if bytes.len() > 84 && stl_bytes == Some(bytes.len() as u64) {
            ("binary STL", "stl")
        } else if head.starts_with(b"solid") && holds(b"facet normal") {
            ("STL", "stl")
        } else if head.starts_with(b"v ") || holds(b"\nv ") {
            ("OBJ", "obj")
        } else {
            return None;
        };
        Some(Content { name, extension })
    }
}

#[cfg(test)]
mod tests {
    use super::Content;

    #[test]
    fn content_gives_the_kind_away() {
        let kind = |bytes: &[u8]| Content::of(bytes).map(|content| content.name);
        assert_eq!(kind(b"ply\r\nformat ascii 1.0\n"), Some("PLY"));
        assert_eq!(kind(b"solid x\n  facet normal 0 0 1\n"), Some("STL"));
        assert_eq!(kind(b"# made by hand\nv 1 2 3\n"), Some("OBJ"));
        assert_eq!(kind(b"some prose\n"), None);
        assert_eq!(kind(b"OFF\n8 6 12\n"), Some("OFF"));
        assert_eq!(kind(b"OFFICE\n"), None);
        assert_eq!(kind(b"glTF\x02\0\0\0"), Some("GLB"));
        assert_eq!(kind(b"<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\">"), Some("COLLADA"));
        assert_eq!(kind(b"plywood"), None);
        assert_eq!(kind(b""), None);
        let mut stl = [0; 134];
        stl[80] = 1;
        assert_eq!(kind(&stl), Some("binary STL"));
        assert_eq!(kind(&stl[..133]), None);
    }
}
