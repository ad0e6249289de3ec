//! What is wrong with an XML text, as 3MF and COLLADA say it.

use quick_xml::Error;
use quick_xml::errors::{IllFormedError, SyntaxError};

/// Said of a text that ends before its root does.
pub(super) const ENDS_EARLY: &str = "the file ends within an element";

/// Why a text cannot be read on.
pub(super) fn why(error: &Error) -> String {
    let within = match error {
        Error::Syntax(SyntaxError::InvalidBangMarkup) => return error.to_string(),
        Error::Syntax(SyntaxError::UnclosedPI | SyntaxError::UnclosedXmlDecl) => "an instruction",
        Error::Syntax(SyntaxError::UnclosedComment) => "a comment",
        Error::Syntax(SyntaxError::UnclosedDoctype) => "a DOCTYPE",
        Error::Syntax(SyntaxError::UnclosedCData) => "a CDATA section",
        Error::Syntax(_) => "a tag",
        Error::IllFormed(IllFormedError::UnclosedReference) => {
            "a reference, or it has no semicolon"
        }
        _ => return error.to_string(),
    };
    format!("the file ends within {within}")
}
