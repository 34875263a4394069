"""Results as data frames and in notebooks."""

import html
import json


def _frame(table):
    import pandas
    frame = pandas.DataFrame(table.to_dict(), columns=table.keys)
    for key in frame.columns:  # a column that is empty, or of numbers and None, is one of numbers
        if all(v is None or isinstance(v, (int, float)) and not isinstance(v, bool) for v in frame[key]):
            if frame[key].isna().any():
                frame[key] = frame[key].astype(float)
    return frame


def _cell(value):
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.5g}" if isinstance(value, float) else html.escape(str(value))


def _table_html(table, most=20):
    columns = table.to_dict()
    shown = [k for k in table.keys if any(v is not None for v in columns[k])]  # without columns that are empty
    heads = "".join(f"<th>{html.escape(h)}{'<br>' + html.escape(u) if u else ''}</th>"
                    for k, h, u in zip(table.keys, table.headings, table.units) if k in shown)
    rows = "".join("<tr>" + "".join(f'<td style="white-space:nowrap">{_cell(columns[k][i])}</td>' for k in shown) + "</tr>"
                   for i in range(min(len(table), most)))
    more = f"<p>{len(table) - most} more rows</p>" if len(table) > most else ""
    return ('<div style="width:0;min-width:100%;overflow-x:auto">'  # scrolls, whatever the width of the cell
            f"<table><caption>{html.escape(table.title)}</caption><tr>{heads}</tr>{rows}</table></div>{more}")


def _result_html(result):
    tables = result.tables
    first = _table_html(next(iter(tables.values()))) if tables else ""
    page = html.escape(result._charts(), quote=True)
    verdict = f"{result.outcome.upper()}: " if result.outcome in ("pass", "fail") else ""
    return (f"<p><b>{verdict}{html.escape(result.sentence)}</b></p>{first}"
            f'<iframe srcdoc="{page}" style="width:100%;height:640px;border:1px solid #ccc"></iframe>')


def _to_pandas(result, table=None):
    """A table as a data frame: the first, or the one of this name (see .tables). None becomes NaN."""
    tables = result.tables
    if table is None:
        return _frame(next(iter(tables.values())))
    if table not in tables:
        raise KeyError(f"no table {table!r}; there are {', '.join(tables)}")
    return _frame(tables[table])


def _json(result):
    """The object that the command prints with --json."""
    return json.loads(result.json_text())


def _write_report(result, file):
    """The report for a browser, one HTML file."""
    with open(file, "w", encoding="utf-8") as out:
        out.write(result.report())


def add_to(result, table):
    """Gives the classes of the module what needs Python."""
    result.to_pandas = _to_pandas
    result.json = _json
    result.write_report = _write_report
    result._repr_html_ = _result_html
    result.__repr__ = lambda self: f"<damslip.{type(self).__name__}: {self.sentence}>"
    table.to_pandas = _frame
    table._repr_html_ = _table_html
