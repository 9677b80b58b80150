"""The figures of the pages are those of the data in docs/results.

A comment above a table or a paragraph names the rows and the data that it is from:

    <!-- figures: stepped.json; rows: gas 100 | game 1,000; digits: 2 -->

rows    the rows of the data, in the order of the table's rows; not needed if the first columns of the table name them.
        For a paragraph or a list: its figures, each as `row @ column`, in any order.
digits  the least number of digits of a whole number before its zeros; 3 by default.
besides the other numbers of a paragraph.

A table may be from several data (`stepped.json, contact.json`); each column is from the first that has it. A row that is
missing in the data is shown as "–". `<!-- figures: none: REASON -->` gives the reason for missing data. In the pages of
TABLES_ARE_FROM_DATA each table with figures has such a comment, in those of ALL_IS_FROM_DATA each paragraph with a measured
figure, too.

A figure is right if it is the data's value, rounded to as many digits as are printed.

Usage: check_figures.py FOLDER, the top folder of the project.
"""

import csv
import importlib.util
import json
import math
import pathlib
import re
import sys

from pages import pages_of

TABLES_ARE_FROM_DATA = ("README.md", "packaging/release_notes_0.1.0.md", "docs/performance.md", "docs/faq.md", "docs/clients.md", "docs/tuning.md", "docs/reliability.md",
                        "docs/demo.md", "docs/log/results.md")
ALL_IS_FROM_DATA = ("docs/performance.md",)
ODE = ("simple", "hash", "quadtree", "sap")

# Names that columns of pages have in the data.
COLUMNS = {
    "contact.json": {"best ODE": "best ODE space", "pairs with contacts": "touching"},
    "worlds_instructions.json": {"ours": "predictive-box", "now": "predictive-box", "best ODE / ours": "ratio"},
    "worlds_times.csv": {"dSpaceCollide": "ratio", "whole tick": "ratio of whole ticks"},
    "scenes_instructions.json": {"ours": "predictive-box", "now": "predictive-box", "best ODE / ours": "ratio"},
}
# Columns that name a row of a CSV file.
KEYS = {
    "clients.csv": ["program", "space"],
    "haptic_loop.csv": ["space"],
    "table1.csv": ["block", "objects", "other"],
    "worlds_by_shape.csv": ["scene", "n"],
    "worlds_times.csv": ["scene", "n"],
}

NAMING = ("line", "scene", "objects", "n", "what", "space")  # columns of pages that name a row
COUNTS = ("objects", "n")

COMMENT = re.compile(r"^<!-- figures: (.*?) -->\n", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"(?<![\w.,])\d+(?:,\d{3})*(?:\.\d+)?(?!\w|[.,]\d)")
UNIT = r"\s*(?:×|%|µs|ms|ns|bytes|MB|times as)"
MEASURED = re.compile(rf"\d\.\d|\d{UNIT}")


def key_of(text):
    """`gas, 10,000` and `gas 10000` are the same key."""
    return re.sub(r"(?<=\d),(?=\d{3})", "", text).replace(",", "").strip()


# --- The data: {name of a row: {column: value}} -----------------------------------------------------------------------


class Data:
    def __init__(self, top):
        self.folder = top / "docs" / "results"
        script = importlib.util.spec_from_file_location("tables", top / "docs" / "plots" / "tables.py")
        self.tables = importlib.util.module_from_spec(script)
        script.loader.exec_module(self.tables)
        self.known = {}

    def rows(self, name):
        if name not in self.known:
            if not (self.folder / name).is_file():
                raise ValueError(f"there is no docs/results/{name}")
            read = self.read_csv if name.endswith(".csv") else self.read_json
            self.known[name] = dict(read(name))
        return self.known[name]

    def json(self, name):
        return json.loads((self.folder / name).read_text())

    def read_json(self, name):
        records = self.json(name)
        if name == "limits.json":
            for record in records:
                if record["space"].startswith("predictive"):
                    yield key_of(f"{record['scene']} {record['n']}"), {
                        "first": record["sap_ratio_first"],
                        "collide": record["sap_ratio_collide"],
                        "destroy": record["sap_ratio_empty"],
                        "bytes": record["bytes_per_object"],
                    }
            return
        if re.fullmatch(r"(worlds|scenes)_instructions\.json", name):
            yield from worlds(records)
            return
        rows = (self.tables.stepped if name == "stepped.json" else self.tables.contact)(records)
        for row in rows:
            yield key_of(f"{row.pop('scene')} {row.pop('objects')}"), row

    def read_csv(self, name):
        with open(self.folder / name, encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                key = key_of(" ".join(row.pop(column) for column in KEYS[name]))
                values = {key_of(column): as_number(cell) for column, cell in row.items()}
                yield key, values


def worlds(records):
    """Thousands of instructions per tick, and the ratio of the best of ODE's spaces to ours; for all worlds, the geometric
    mean of these ratios."""
    sums = {}
    for record in records:
        sums.setdefault(key_of(f"{record['scene']} {record['n']}"), {})[record["space"]] = record["sum"] / 1000
    ratios = []
    for row, spaces in sums.items():
        best = min((spaces[name] for name in ODE if name in spaces), default=None)
        ratio = best / spaces["predictive-box"] if best else None
        ratios += [ratio] if ratio else []
        yield row, spaces | {"ratio": ratio}
    yield "all", {"ratio": math.prod(ratios) ** (1 / len(ratios))}


def as_number(cell):
    found = re.fullmatch(r"([\d.]+)( %)?", cell)
    return float(found[1]) if found else cell


def single(value):
    """The figure itself, if it comes with its space or is one of a sum."""
    if isinstance(value, tuple):
        return value[0] if isinstance(value[1], str) else value[-1]
    return as_number(value) if isinstance(value, str) else value


# --- Figures ----------------------------------------------------------------------------------------------------------


def is_rounded(printed, value, digits):
    """Whether the value, rounded like the printed number, is that number."""
    plain = printed.replace(",", "")
    unit = 10.0 ** -len(plain.partition(".")[2])
    if "." not in plain:
        zeros = min(len(plain) - len(plain.rstrip("0")), max(0, len(plain) - digits))
        unit = 10.0**zeros
    return abs(float(plain) - value) <= unit / 2 * (1 + 1e-9)


def is_cell(cell, value, digits):
    if value is None or value == "":
        return cell == "–"
    if isinstance(value, str) and as_number(value) == value:
        return cell == value
    number = NUMBER.search(cell)
    name = re.search(r"\((\w+)\)", cell)
    if name and isinstance(value, tuple) and name[1] != value[1]:
        return False
    return bool(number) and is_rounded(number[0], single(value), digits)


def plain(text):
    """The text without markup and addresses."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"<[^>]*>", "", text).replace("**", "").replace("`", "").strip()


def cells_of(line):
    return [plain(cell) for cell in line.strip().strip("|").split("|")]


def has_figures(block):
    """Whether it is a table with a cell that begins with a number, or a paragraph with a measured one."""
    if block.startswith("|"):
        return any(re.match(r"[≤≥~−]?\d", cell) for line in block.splitlines()[2:] for cell in cells_of(line))
    return bool(MEASURED.search(plain(re.sub(r"`[^`]*`", "", block))))


class Claim:
    """The content of a comment."""

    def __init__(self, comment, data):
        words = re.sub(r"\s+", " ", comment)
        sources, *rest = words.split("; ")
        options = dict(part.split(": ", 1) for part in rest)
        self.sources = sources.split(", ")
        self.data = [(COLUMNS.get(name, {}), data.rows(name)) for name in self.sources]
        self.rows = [key_of(row) for row in options.pop("rows", "").split(" | ") if row]
        self.digits = int(options.pop("digits", 3))
        self.besides = options.pop("besides", "").split(", ")
        if options:
            raise ValueError(f"what is \"{', '.join(options)}\"?")
    def value(self, row, column):
        for names, rows in self.data:
            name = names.get(column, column)
            if any(name in cells for cells in rows.values()):
                return rows.get(row, {}).get(name)
        raise ValueError(f"no column \"{column}\" in {', '.join(self.sources)}")

    def row(self, row):
        if not any(row in rows for _, rows in self.data):
            raise ValueError(f"no row \"{row}\" in {', '.join(self.sources)}")
        return row

    def table(self, block):
        head, _, *lines = map(cells_of, block.splitlines())
        named = 1 if self.rows else sum(1 for column in head if column in NAMING)
        if self.rows and len(self.rows) != len(lines):
            raise ValueError(f"{len(lines)} rows, but {len(self.rows)} are named in the comment")
        figures = 0
        for index, cells in enumerate(lines):
            row = self.row(self.rows[index] if self.rows else key_of(" ".join(cells[:named])))
            for column, cell in list(zip(head, cells))[named:]:
                column = re.sub(r", µs$", "", column)
                if column in NAMING:
                    if column in COUNTS and not row.split()[-1] == key_of(cell):
                        yield f"{row}: {column} is \"{cell}\""
                    continue
                value = self.value(row, column)
                figures += 1
                if not is_cell(cell, value, self.digits):
                    yield f"{row}, {column}: \"{cell}\" is {value} in the data"
        if figures == 0:
            yield "nothing is compared"

    def paragraph(self, block):
        """The numbers of a paragraph are exactly those that the comment names, also in units a thousand times as large."""
        values = {}
        for name in self.rows:
            row, _, column = name.partition(" @ ")
            values[name] = single(self.value(self.row(row), column))
        if not values:
            yield "the comment names no figures"
        printed = [number for number in NUMBER.findall(plain(re.sub(r"`[^`]*`", "", block)))]
        shown = lambda number, value: any(is_rounded(number, value / unit, self.digits) for unit in (1, 1000))
        for number in printed:
            if number not in self.besides and not any(shown(number, value) for value in values.values()):
                yield f"{number} is none of the figures that the comment names"
        for name, value in values.items():
            if not any(shown(number, value) for number in printed):
                yield f"{name} is {value} in the data, which is not in the text"


# --- Pages ------------------------------------------------------------------------------------------------------------


def blocks_of(text):
    """(line, comment or None, table or paragraph), without blocks of code."""
    text = re.sub(r"^ *```.*?^ *```$", lambda found: re.sub(r"[^\n]+", "", found[0]), text, flags=re.MULTILINE | re.DOTALL)
    comments = {}
    for found in COMMENT.finditer(text):
        comments[found.end()] = found[1]
    text = COMMENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    for found in re.finditer(r"^(?=\S).*?(?=\n[ \t]*\n|\Z)", text, re.MULTILINE | re.DOTALL):
        yield text.count("\n", 0, found.start()) + 1, comments.pop(found.start(), None), found[0].rstrip()
    for place in comments:
        yield text.count("\n", 0, place), "", "nothing below the comment"


def mistakes_of(block, comment, data):
    if comment.startswith("none: ") and len(comment) > len("none: "):
        return
    try:
        claim = Claim(comment, data)
        yield from claim.table(block) if block.startswith("|") else claim.paragraph(block)
    except (ValueError, KeyError) as error:
        yield str(error)


def mistakes(top):
    data = Data(top)
    for page in pages_of(top):
        name = str(page.relative_to(top))
        for line, comment, block in blocks_of(page.read_text()):
            if comment is not None:
                yield from (f"{name}:{line}: {mistake}" for mistake in mistakes_of(block, comment, data))
            elif has_figures(block) and name in (TABLES_ARE_FROM_DATA if block.startswith("|") else ALL_IS_FROM_DATA):
                yield f"{name}:{line}: no comment `<!-- figures: ... -->` says where these figures are from: {block[:60]!r}"


if __name__ == "__main__":
    found = list(mistakes(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
