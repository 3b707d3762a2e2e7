//! Text → XML, or why it is none; and whether it is a robot description at all.

use roxmltree::{Document, Error, Node, ParsingOptions, TextPos};
use ulna_table::diagnostics::{Diagnostic, Sink};

use crate::robot::Span;

/// The most elements, texts and comments together; a humanoid with its hands has some thousands.
const MOST_NODES: u32 = 1_000_000;

/// The tree of `text`, whose root is `<robot>`. `None` if something has been reported.
///
/// Entities are not expanded, and nothing that the text refers to is opened.
pub(crate) fn document<'t>(text: &'t str, sink: &Sink) -> Option<Document<'t>> {
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: MOST_NODES,
        entity_resolver: None,
    };
    match Document::parse_with_options(text, options) {
        Ok(document) => match foreign(document.root_element()) {
            None => Some(document),
            Some((message, help)) => {
                let span = tag(text, document.root_element());
                sink.push(Diagnostic::error(span, message).help(help));
                None
            }
        },
        Err(error) => {
            sink.push(malformed(text, &error));
            None
        }
    }
}

/// Whether the element is written without a prefix, whatever the default namespace is.
pub(crate) fn is_plain(text: &str, node: Node) -> bool {
    let written = text.get(node.range().start + 1..).unwrap_or_default();
    let after = written.strip_prefix(node.tag_name().name());
    // A prefix may be the name itself.
    node.is_element() && after.is_some_and(|after| !after.starts_with(':'))
}

/// The start tag's name, with its bracket.
pub(crate) fn tag(text: &str, node: Node) -> Span {
    let start = node.range().start;
    let written = text.get(start..).unwrap_or_default();
    let length = written.find(|c: char| c.is_whitespace() || c == '>' || c == '/');
    start..start + length.unwrap_or(1)
}

/// What a file is whose root element is none of a robot description, and what to do.
fn foreign(root: Node) -> Option<(String, String)> {
    let (what, help) = match root.tag_name().name() {
        "robot" => return None,
        "sdf" | "world" => (
            "this is SDF, the format of Gazebo, not URDF",
            "give the URDF that it was made from; `gz sdf` converts URDF to SDF, and not back",
        ),
        "mujoco" | "mujocoinclude" => (
            "this is MJCF, the format of MuJoCo, not URDF",
            "give the robot's URDF; most models of MuJoCo name the one that they were made from",
        ),
        "COLLADA" => (
            "this is a mesh (COLLADA), not URDF",
            "give the file that names its links and joints: it begins with <robot>",
        ),
        other => {
            return Some((
                format!("the root element is <{other}>, not <robot>: this is no URDF"),
                "give a robot description: <robot name=\"...\"> with <link> and <joint> in it"
                    .to_owned(),
            ));
        }
    };
    Some((what.to_owned(), help.to_owned()))
}

/// The error of a text that is not well-formed.
fn malformed(text: &str, error: &Error) -> Diagnostic {
    let at = byte(text, error.pos());
    let here = at..at + 1;
    let end = text.trim_end().len();
    let ended = end.saturating_sub(1)..end;
    if text.trim().is_empty() {
        return Diagnostic::file_error("the file is empty").help("give a robot description (URDF)");
    }
    if !text
        .trim_start_matches('\u{feff}')
        .trim_start()
        .starts_with('<')
    {
        let start = text.len() - text.trim_start_matches('\u{feff}').trim_start().len();
        let help = if text.contains("[[joint]]") {
            "this looks like an arm's table already: `ulna check` reads it"
        } else {
            "give a robot description: a text that begins with <robot> or <?xml"
        };
        return Diagnostic::error(start..start + 1, "not XML").help(help);
    }
    match error {
        Error::UnexpectedCloseTag(expected, found, _) => Diagnostic::error(
            here,
            format!("not well-formed: </{found}> stands where <{expected}> is to be closed"),
        )
        .help(format!(
            "close <{expected}> first, or look for a tag without its pair above"
        )),
        Error::UnknownNamespace(prefix, _) if prefix == "xacro" => unexpanded(here, 1),
        Error::UnknownNamespace(prefix, _) => Diagnostic::error(
            here,
            format!("not well-formed: nothing says what the prefix `{prefix}:` is"),
        )
        .help(format!(
            "write xmlns:{prefix}=\"http://example.org/{prefix}\" into <robot>, or take these elements out: they are not read"
        )),
        Error::DtdDetected => {
            let start = text.find("<!DOCTYPE").unwrap_or(0);
            Diagnostic::error(
                start..start + "<!DOCTYPE".len(),
                "the file declares a document type; entities are never expanded",
            )
            .help("take <!DOCTYPE ...> out, and write what its entities stand for where they stand")
        }
        Error::UnknownEntityReference(name, _) => Diagnostic::error(
            here,
            format!("not well-formed: `&{name};` is no entity of XML, and none is expanded"),
        )
        .help("write the text itself; a plain & is written &amp;"),
        Error::MalformedEntityReference(_) => {
            Diagnostic::error(here, "not well-formed: `&` begins an entity that does not end")
                .help("a plain & is written &amp;")
        }
        Error::DuplicatedAttribute(name, _) => Diagnostic::error(
            here,
            format!("not well-formed: the attribute `{name}` stands twice in one element"),
        )
        .help("write it once"),
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => Diagnostic::error(
            ended,
            "not well-formed: the file ends before all elements are closed",
        )
        .help("was it copied whole? It should end with </robot>"),
        Error::NoRootNode => {
            Diagnostic::error(ended, "not well-formed: there is no element in the file")
                .help("give a robot description: <robot name=\"...\"> with <link> and <joint> in it")
        }
        Error::NodesLimitReached => Diagnostic::file_error(format!(
            "the file has more than {MOST_NODES} elements and texts"
        ))
        .help("a robot description has some thousands"),
        other => {
            let text = other.to_string();
            let words = text.split(" at ").next().unwrap_or_default();
            Diagnostic::error(here, format!("not well-formed: {words}"))
                .help("mend the XML; `xmllint FILE` shows more of it")
        }
    }
}

/// The error of a file with xacro's macros in it, `count` of them, the first at `span`.
pub(crate) fn unexpanded(span: Span, count: usize) -> Diagnostic {
    let more = match count {
        0 | 1 => String::new(),
        2 => ", here and at one more place".to_owned(),
        _ => format!(", here and at {} more places", count - 1),
    };
    Diagnostic::error(
        span,
        format!("this is a source of xacro, whose macros are not expanded{more}"),
    )
    .help("run `xacro FILE > robot.urdf`, with the file's arguments as name:=value, and import robot.urdf")
}

/// Where a position of the XML reader is in the text.
fn byte(text: &str, position: TextPos) -> usize {
    let row = position.row.saturating_sub(1) as usize;
    let start = match row {
        0 => 0,
        _ => text
            .match_indices('\n')
            .nth(row - 1)
            .map_or(text.len(), |(newline, _)| newline + 1),
    };
    let line = &text[start..];
    let column = position.col.saturating_sub(1) as usize;
    let offset = line
        .char_indices()
        .nth(column)
        .map_or(line.len(), |(at, _)| at);
    start + offset
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_found_again() {
        let text = "<a>\n\u{e9}<b>\n";
        assert_eq!(byte(text, TextPos::new(1, 1)), 0);
        assert_eq!(byte(text, TextPos::new(2, 2)), 6);
        assert_eq!(byte(text, TextPos::new(9, 9)), text.len());
    }
}
