//! Templates with their placeholders filled in.

/// `template` with the second of each of `values` wherever the first stands in it.
///
/// In one pass: what has been filled in is not looked at again, whatever an arm is called.
pub(super) fn fill(template: &str, values: &[(&str, &str)]) -> String {
    let mut filled = String::with_capacity(template.len());
    let mut rest = template;
    while let Some(next) = rest.chars().next() {
        let found = values
            .iter()
            .find_map(|(placeholder, value)| Some((rest.strip_prefix(placeholder)?, value)));
        if let Some((after, value)) = found {
            filled.push_str(value);
            rest = after;
        } else {
            filled.push(next);
            rest = &rest[next.len_utf8()..];
        }
    }
    filled
}
