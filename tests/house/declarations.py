# SPDX-License-Identifier: BSD-3-Clause
"""Declarations of namespaces and classes, read from the text of a header that clang-format has set."""

import re


def blanked(text):
    """The text with blanks for comments, strings and directives: what is left stays where it was."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))

    text = re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.DOTALL)
    text = re.sub(r'"(\\.|[^"\\\n])*"', blank, text)
    return re.sub(r"^#[^\n]*(?:\\\n[^\n]*)*", blank, text, flags=re.MULTILINE)


TEMPLATE = r"template\s*<(?:[^<>]|<[^<>]*>)*>\s*"


def declarations(text):
    """(offset, scope, declaration, what ends it: `;` or `{`) for each, its template head left out."""
    text, scopes, start, parentheses = blanked(text), [], 0, 0
    for mark in re.finditer(r"[;{}():]", text):
        at, sign = mark.start(), mark.group(0)
        parentheses += {"(": 1, ")": -1}.get(sign, 0)
        if parentheses or sign in "()":
            continue
        if sign == ":":
            if re.search(r"\b(public|private|protected)\s*$", text[start:at]):
                start = at + 1
            continue
        start += re.match(rf"\s*(?:{TEMPLATE})?", text[start:at]).end()
        declaration, scope = text[start:at].rstrip(), scopes[-1] if scopes else "namespace"
        if sign != "}" and scope != "body":
            yield start, scope, declaration, sign
        if sign == "{":
            named = re.match(r"(?:inline )?(namespace|class|struct|union)\b", declaration)
            scopes.append("body" if scope == "body" or not named or declaration.endswith(")")
                          else "namespace" if named.group(1) == "namespace" else "class")
        elif sign == "}":
            scopes.pop()
        start = at + 1


def gives_an_answer(scope, declaration, end):
    """Whether this is a function that is called for what it returns: free, static or const, with no argument to write."""
    head, _, arguments = re.sub(r"\[\[.*?\]\]\s*", "", declaration).partition("(")
    if not arguments or re.match(r"(using|extern|enum|requires|static_assert|concept)\b", head) or re.search(r"operator|~|=", head):
        return False
    if re.search(r"=\s*(delete|default)$", declaration) or (head.startswith("friend") and end == ";"):
        return False
    if scope == "class" and not re.match(r"(static|friend)\b", head) and not re.search(r"\)\s*const\b[^()]*$", arguments):
        return False
    if re.search(r"(^|, *)(?!const\b)[\w:]+(<[^()]*>)? *& *\w+", re.sub(r"\s+", " ", arguments)):
        return False
    returned = re.sub(r"\b(inline|constexpr|static|virtual|explicit|friend)\b", "", head).strip().rpartition(" ")[0].strip()
    return returned not in ("", "void") and (returned.startswith("const ") or not returned.endswith("&"))
