#!/usr/bin/env python3
"""Puts some rows of the hard cases, measured by themselves, into docs/accuracy.md and its CSV.

accuracy_rows.py ROWS BESIDE MADE ENVIRONMENT [DOCS]: the ids of the rows and of the rows that were measured
beside them, as "H32,H33"; the folder that `hard_cases --out` wrote; and where it ran, in words. The
latter rows stay as they are: their costs, then and now, say how far costs of both runs compare.
DOCS: the folder of the page, docs of this repository unless said.
"""

import pathlib
import re
import statistics
import sys

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"


def order(case):
    return int(re.fullmatch(r"H(\d+)", case).group(1))


def block(page, name):
    """The lines between a block's markers, and what stands before and behind them."""
    begin, end = f"<!-- {name}:begin -->\n", f"<!-- {name}:end -->\n"
    before, rest = page.split(begin)
    inside, behind = rest.split(end)
    return before + begin, inside.splitlines(), end + behind


def merged(old, new, case_of, wanted):
    """Old and new lines in order of their cases; new ones instead of old ones of the same case."""
    lines = [line for line in old if case_of(line) not in wanted]
    lines += [line for line in new if case_of(line) in wanted]
    return sorted(lines, key=lambda line: order(case_of(line)))  # stable


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split(" | ")]


def table_rows(lines):
    """Rows of a table with the columns of another one: engines that were not run are named so."""
    return cells(lines[0])[3:], lines[2:]


def in_columns(line, engines, columns):
    found = cells(line)
    by_engine = dict(zip(engines, found[3:]))
    return "| " + " | ".join(found[:3] + [by_engine.get(c, "not run") for c in columns]) + " |"


def costs(line, engines):
    values = {}
    for engine, cell in zip(engines, cells(line)[3:]):
        if "<br>" in cell and float(cell.split("<br>")[1]) > 0:
            values[engine] = float(cell.split("<br>")[1])
    return values


def ratios(old, new, columns, engines, beside):
    """Costs now over costs then, of the same cell."""
    then = {tuple(cells(line)[:2]): costs(line, columns) for line in old}
    found = []
    for line in new:
        key = tuple(cells(line)[:2])
        if key[0] not in beside or key not in then:
            continue
        found += [now / then[key][e] for e, now in costs(line, engines).items() if e in then[key]]
    return sorted(found)


def main(rows, beside, made, environment, docs=DOCS):
    rows, beside, made = rows.split(","), beside.split(","), pathlib.Path(made)
    page_file, csv_file = pathlib.Path(docs) / "accuracy.md", pathlib.Path(docs) / "accuracy/hard_cases.csv"
    page = page_file.read_text()

    before, old, behind = block(page, "hard_cases")
    columns, old_rows = table_rows(old)
    engines, new_rows = table_rows((made / "hard_cases.md").read_text().splitlines())
    compared = ratios(old_rows, new_rows, columns, engines, beside)
    new_rows = [in_columns(line, engines, columns) for line in new_rows]
    table = merged(old_rows, new_rows, lambda line: cells(line)[0].strip("| "), rows)
    page = before + "\n".join(old[:2] + table) + "\n" + behind

    before, old, behind = block(page, "hard_cases_failures")
    new = (made / "hard_cases_failures.md").read_text().splitlines()
    lines = merged(old, new, lambda line: line[2:].split(",")[0], rows)
    page = before + "\n".join(lines) + "\n" + behind

    before, _, behind = block(page, "hard_cases_rows")
    note = (
        f"The rows {', '.join(rows)} were measured by themselves, once ({environment}), and are not in the "
        f"chart. {', '.join(beside)}, measured in the same run, cost {statistics.median(compared):.1f} times "
        f"what the table says of them (median of {len(compared)} cells; {compared[0]:.1f} to "
        f"{compared[-1]:.1f}): by so much the costs of these rows are too high beside the others."
    )
    page_file.write_text(before + note + "\n" + behind)

    head, *old = csv_file.read_text().splitlines()
    new = (made / "hard_cases.csv").read_text().splitlines()[1:]
    lines = merged(old, new, lambda line: line.split(",")[0], rows)
    csv_file.write_text("\n".join([head] + lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
