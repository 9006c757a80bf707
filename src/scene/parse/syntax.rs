//! What to write instead of a value that is no TOML.

/// The remedy where the parser stopped at byte `at` of `text`: habits of other formats are answered with the right spelling.
pub(super) fn remedy(text: &str, at: usize) -> String {
    let begin = text.get(..at).map_or(0, |before| before.rfind('\n').map_or(0, |feed| feed + 1));
    let line = text.get(begin..).unwrap_or_default().lines().next().unwrap_or_default();
    let value = line.split_once('=').map_or(line, |(_, value)| value);
    let value = value.split('#').next().unwrap_or_default().trim();
    spelled(value).unwrap_or_else(|| "correct the syntax (https://toml.io has the rules)".into())
}

/// Sizes, percentages and units.
fn spelled(value: &str) -> Option<String> {
    if let Some((width, height)) = value.split_once(['x', 'X', '×']) {
        let sides: [u32; 2] = [width.trim().parse().ok()?, height.trim().parse().ok()?];
        return Some(format!("write `{sides:?}`"));
    }
    let end = value.find(|c: char| !c.is_ascii_digit() && !"+-._".contains(c))?;
    let (number, unit) = (value[..end].parse::<f64>().ok()?, value[end..].trim());
    match unit {
        "%" => Some(format!("write a share, `{}`", number / 100.0)),
        _ if unit.chars().all(|c| c.is_alphabetic() || "°µ²³/".contains(c)) => Some(format!(
            "write the number alone, such as `{number}`: lengths are in metres, angles in degrees"
        )),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn habits_of_other_formats() {
        for (text, at, part) in [
            ("5%", 0, "`0.05`"),
            ("160x90", 0, "`[160, 90]`"),
            ("a = 1\nrange = 1 km # far\nb = 2", 14, "`1`: lengths are in metres"),
            ("vertical_fov = 45.5°", 19, "`45.5`"),
            ("a = 5 5", 6, "toml.io"),
            ("name = floor", 7, "toml.io"),
            ("size = 0x1g", 7, "toml.io"),
            ("[render", 7, "toml.io"),
            ("é", 1, "toml.io"),
            ("", 0, "toml.io"),
        ] {
            assert!(remedy(text, at).contains(part), "{text}: {}", remedy(text, at));
        }
    }
}
