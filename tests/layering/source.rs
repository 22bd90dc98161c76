//! Finds the paths that a Rust source names: its `use` trees and the paths in code, inside macro calls too.

use proc_macro2::{Delimiter, Group, LexError, TokenStream, TokenTree};
use std::collections::HashSet;

/// A path that a source file names, with `self`, `super` and this crate's name resolved to `crate::…`.
#[derive(Debug)]
pub struct Mention {
    /// The path's segments. A macro's name includes its `!`; a glob ends in `*`.
    pub path: Vec<String>,
    pub line: usize,
    /// Whether the path is in an item under `#[cfg(test)]`.
    pub in_test: bool,
}

/// All paths that `source` names, where `source` is the file of the module with path `modules` from the crate's root.
pub fn mentions(source: &str, modules: &[String], in_test: bool) -> Result<Vec<Mention>, LexError> {
    let tokens: TokenStream = source.parse()?;
    let mut scan = Scan { modules: modules.to_vec(), own_modules: HashSet::new(), found: Vec::new() };
    scan.walk(tokens, in_test);
    // A module of the file may have the name of a crate, and may be declared below its first use.
    let Scan { own_modules, mut found, .. } = scan;
    found.retain(|mention| !own_modules.contains(&mention.path[0]));
    Ok(found)
}

struct Scan {
    /// Path of the module that contains the current tokens.
    modules: Vec<String>,
    /// Names of all modules that the file declares.
    own_modules: HashSet<String>,
    found: Vec<Mention>,
}

impl Scan {
    fn walk(&mut self, tokens: TokenStream, in_test: bool) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        // Set by `#[cfg(test)]` until the end of the item below it.
        let mut test_item = false;
        let mut at = 0;
        while at < tokens.len() {
            let in_test = in_test || test_item;
            match &tokens[at..] {
                [TokenTree::Punct(hash), TokenTree::Group(group), ..] if hash.as_char() == '#' => {
                    test_item |= is_cfg_test(group);
                    self.walk(group.stream(), in_test);
                    at += 2;
                }
                [TokenTree::Ident(word), rest @ ..] if word == "use" => {
                    let end = rest.iter().position(|t| is_punct(t, ';')).unwrap_or(rest.len());
                    self.use_tree(&rest[..end], &[], in_test);
                    test_item = false;
                    at += end + 2;
                }
                [TokenTree::Ident(word), TokenTree::Ident(name), rest @ ..] if word == "mod" => {
                    self.own_modules.insert(name.to_string());
                    if let Some(TokenTree::Group(body)) = rest.first() {
                        self.modules.push(name.to_string());
                        self.walk(body.stream(), in_test);
                        self.modules.pop();
                    }
                    test_item = false;
                    at += 3;
                }
                [TokenTree::Ident(_), ..] => {
                    let continues =
                        at > 2 && is_separator(&tokens[at - 2..]) && is_punct(&tokens[at - 3], '>');
                    at += self.path_in_place(&tokens[at..], continues, in_test);
                }
                [TokenTree::Group(group), ..] => {
                    self.walk(group.stream(), in_test);
                    test_item &= group.delimiter() != Delimiter::Brace;
                    at += 1;
                }
                [other, ..] => {
                    test_item &= !is_punct(other, ';');
                    at += 1;
                }
                [] => break,
            }
        }
    }

    /// Reads `a::b::c` or `name!` at the start of `tokens`; returns the number of tokens read.
    fn path_in_place(&mut self, tokens: &[TokenTree], continues: bool, in_test: bool) -> usize {
        let mut path = vec![tokens[0].to_string()];
        let mut taken = 1;
        while let [a, b, TokenTree::Ident(name), ..] = &tokens[taken..]
            && is_separator(&[a.clone(), b.clone()])
        {
            path.push(name.to_string());
            taken += 3;
        }
        let is_macro = tokens.get(taken).is_some_and(|t| is_punct(t, '!'))
            && matches!(tokens.get(taken + 1), Some(TokenTree::Group(_)));
        if is_macro && path.len() == 1 {
            path[0].push('!');
        }
        if (is_macro || path.len() > 1) && !continues {
            self.mention(path, &tokens[0], in_test);
        }
        taken
    }

    /// Splits a `use` tree such as `a::{b, c::*, d as e}` into paths.
    fn use_tree(&mut self, tokens: &[TokenTree], prefix: &[String], in_test: bool) {
        for branch in tokens.split(|t| is_punct(t, ',')) {
            let mut path = prefix.to_vec();
            for token in branch {
                match token {
                    TokenTree::Ident(word) if word == "as" => break,
                    TokenTree::Ident(name) => path.push(name.to_string()),
                    TokenTree::Punct(star) if star.as_char() == '*' => path.push("*".to_owned()),
                    TokenTree::Group(group) => {
                        let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                        self.use_tree(&inner, &path, in_test);
                    }
                    _ => {}
                }
            }
            if let Some(last) = branch.last().filter(|last| !matches!(last, TokenTree::Group(_))) {
                // `use std::fs::{self}` means `use std::fs`.
                if path.len() > 1 && path.last().is_some_and(|name| name == "self") {
                    path.pop();
                }
                self.mention(path, last, in_test);
            }
        }
    }

    fn mention(&mut self, path: Vec<String>, at: &TokenTree, in_test: bool) {
        let ups = path.iter().skip_while(|name| *name == "self").take_while(|name| *name == "super").count();
        let path: Vec<String> = match path[0].as_str() {
            "self" | "super" => {
                let base = &self.modules[..self.modules.len().saturating_sub(ups)];
                let rest = path.into_iter().skip_while(|name| name == "self" || name == "super");
                std::iter::once("crate".to_owned()).chain(base.iter().cloned()).chain(rest).collect()
            }
            "dichroscope" => std::iter::once("crate".to_owned()).chain(path.into_iter().skip(1)).collect(),
            _ => path,
        };
        self.found.push(Mention { path, line: at.span().start().line, in_test });
    }
}

fn is_punct(token: &TokenTree, mark: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == mark)
}

/// Whether the tokens begin with `::`.
fn is_separator(tokens: &[TokenTree]) -> bool {
    tokens.len() > 1 && tokens[..2].iter().all(|t| is_punct(t, ':'))
}

/// Whether the tokens after the `#` of an attribute are `[cfg(test)]` or `[cfg(all(test, …))]`.
fn is_cfg_test(attribute: &Group) -> bool {
    let text: String = attribute.to_string().split_whitespace().collect();
    text == "[cfg(test)]" || text.starts_with("[cfg(all(test,")
}
