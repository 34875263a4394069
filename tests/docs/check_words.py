"""The words that docs/symbols.md rules out (second column of its table "Words") do not stand in README.md, docs/*.md, nor in sentences of
the program, but where they are code (in backticks, or a block).
   check_words.py SOURCE
"""
import glob
import os
import re
import sys
from pathlib import Path

os.chdir(sys.argv[1])
table = Path("docs/symbols.md").read_text().split("\n## Words", 1)[1]
words = [word for row in table.splitlines() if row.count("|") > 3 for word in re.findall("`([^`]*)`", row.split("|")[2])]
if len(words) < 15:
    sys.exit(f"docs/symbols.md: only {len(words)} words are ruled out")
ruled_out = re.compile(r"(?<!\w)(?:" + "|".join(map(re.escape, words)) + r")(?!\w)", re.I)


def prose(text):
    """Of a page, line by line: no blocks, no code, no addresses of links."""
    code = False
    for line in text.splitlines():
        fence = line.startswith("```")
        code ^= fence
        yield "" if fence or code or line.startswith("    ") else re.sub(r"\]\([^)]*\)", "]", re.sub("`[^`]*`", "", line))


def sentences(text):
    """The strings of a source that have a blank in them, line by line."""
    for line in text.splitlines():
        line = re.sub("--[a-z]*", "", re.sub("//.*", "", line))
        yield " ".join(word for word in re.findall(r'"(?:[^"\\]|\\.)*"', line) if " " in word)


failed = False
sources = [name for place in ("src/pages/*/*.cpp", "src/cli/*.cpp", "src/scene/*.cpp", "src/analysis/*/*.cpp") for name in glob.glob(place)]
for names, lines in ((["README.md", *glob.glob("docs/*.md")], prose), (sources, sentences)):
    for name in sorted(names):
        for number, line in enumerate(lines(Path(name).read_text()), 1):
            if name != "docs/symbols.md" and (hit := ruled_out.search(line)):
                print(f"{name}:{number}: docs/symbols.md has another word for {hit[0]}: {line.strip()[:140]}", file=sys.stderr)
                failed = True
sys.exit(failed)
