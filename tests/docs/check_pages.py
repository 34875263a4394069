"""README.md and docs/*.md: every link leads somewhere, every page is in the index docs/README.md and every figure on a page; the files,
verification cases, commands and flags they name are there.
   check_pages.py DAMSLIP SOURCE
"""
import glob
import os
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

program = sys.argv[1]
os.chdir(sys.argv[2])
faults = []
pages = {name: Path(name).read_text() for name in ["README.md", *sorted(glob.glob("docs/*.md"))]}


def anchors(text):
    """GitHub's: lower case, blanks to hyphens, other signs than letters, digits, hyphens and underscores gone."""
    for title in re.findall(r"^#+ (.*)$", text, re.M):
        title = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title.replace("`", ""))
        yield re.sub(r"[.,:;()/!?\"=+*']", "", title.lower().replace(" ", "-"))


def without_code(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    return re.sub(r"^    .*$", "", text, flags=re.M)


@cache
def printed(*words):
    """What the program prints, None where it has no such command."""
    run = subprocess.run([program, *words], capture_output=True, text=True)
    return run.stdout if run.returncode == 0 else None


linked = set()
for page, text in pages.items():
    for link in sorted(set(re.findall(r"\]\(([^)\n]*)\)", without_code(text)))):
        if link.startswith(("http://", "https://")):
            continue
        file, _, heading = link.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(page), file)) if file else page
        if not os.path.exists(target):
            faults.append(f"{page}: {link} leads nowhere")
            continue
        if target != page:
            linked.add(target)
        if heading and heading not in anchors(Path(target).read_text()):
            faults.append(f"{page}: {link} has no such heading")
    # Files of the source tree in backticks: a path with a folder of it in front.
    for file in sorted(set(re.findall(r"`((?:src|sliding|fe2d|records|verification|studies|tests|examples|scripts|docs|cmake)/[A-Za-z0-9_./-]+)`", text))):
        if not os.path.exists(file) and not glob.glob(file + ".*"):
            faults.append(f"{page}: {file} is not there")

for file in sorted([*glob.glob("docs/*.md"), *glob.glob("docs/figures/*"), *glob.glob("docs/*.svg")]):
    if file == "docs/README.md":
        continue
    if file not in linked:
        faults.append(f"{file}: no page links to it")
    if file.endswith(".md") and f"]({file.removeprefix('docs/')}" not in pages["docs/README.md"]:
        faults.append(f"docs/README.md does not list {file}")

# "Where is ..." of the layout: the functions of a row are in one of its files.
for row in re.findall(r"^\| .*\.[ch]pp`.*$", pages["docs/layout.md"], re.M):
    sources = [Path(file).read_text() for file in re.findall(r"`([A-Za-z0-9_/]*\.[ch]pp)`", row) if os.path.exists(file)]
    for name in re.findall(r"`([A-Za-z_:]*)\(\)`", row):
        if not any(re.search(rf"(^|[^A-Za-z_]){name.split('::')[-1]}\(", source, re.M) for source in sources):
            faults.append(f"docs/layout.md: {name}() is not in a file of its row")

# Commands: lines of code that call the program, and calls in backticks.
commands = set()
for text in pages.values():
    for call in re.findall(r"^    (?:build/release/)?(damslip .*)$", text, re.M) + re.findall(r"`(damslip [^`\n]*)`", text):
        commands.add(re.sub(r" +#.*| > .*|[|\\].*", "", call))
cases = printed("verify", "--list") + printed("verify", "--hard", "--list")
for call in sorted(commands):
    _, command, *words = call.split() + [""] * (len(call.split()) == 1)
    if not re.match(r"[^-A-Z]", command):
        continue
    path = [command]
    if command == "record":
        if not words or words[0] not in ("info", "convert", "baseline", "scale", "spectrum", "generate"):
            continue
        path.append(words[0])
    text = printed(*path, "--help")
    if text is None:
        faults.append(f"{call}: there is no such command")
        continue
    for flag in [word.split("=")[0] for word in words if word.startswith("--")]:
        if not re.search(rf"(^|[ ,]){re.escape(flag)}([ ,]|$)", text, re.M):
            faults.append(f"{call}: {' '.join(path)} has no {flag}")
    if command == "verify" and words and re.match("[a-z]", words[0]) and words[0] not in cases:
        faults.append(f"{call}: there is no such case")
if len(commands) < 30:
    faults.append(f"only {len(commands)} commands were found")

print("\n".join(faults), file=sys.stderr)
sys.exit(bool(faults))
