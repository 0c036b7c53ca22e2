"""Numbers and names as pages show them."""

import re


def words(name):
    return name.replace("_", " ")


def sentence(text):
    return text[:1].upper() + text[1:]


def number(value, digits=5):
    """A number as a table shows it: 5 digits, 1.5e-5."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        return str(value)
    text = f"{value:.{digits}g}"
    return re.sub(r"e([+-])0*(\d)", lambda m: "e" + m[1].replace("+", "") + m[2], text)


def shortened(text):
    """A sentence whose numbers have at most six digits."""
    return re.sub(r"\d+\.\d+(?:e[-+]\d+)?", lambda m: number(float(m[0]), 6), str(text or "").replace("e-0", "e-"))


def number_words(text):
    """A gate's bound with its signs as they are printed."""
    return shortened(text).replace("<=", "≤").replace(">=", "≥")
