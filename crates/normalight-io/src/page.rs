//! What the pages that the command writes have in common: files that need nothing beside them.

/// Their style: colours for light and dark, text, tables whose heads are buttons.
pub const PAGE_STYLE: &str = include_str!("page/page.css");

/// Sorts the rows of a table by the column whose head is pressed, numbers by their value. Each cell says what it sorts by as
/// `data-key`.
pub const PAGE_SCRIPT: &str = include_str!("page/page.js");
