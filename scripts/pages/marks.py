# SPDX-License-Identifier: BSD-3-Clause
"""What a page of the documentation holds of the program's figures: where they stand, and whether they are what is found."""
import csv
import functools
import os
import re
import shlex
import subprocess
import sys
import tempfile

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
PIXEL = re.compile(r"M\d+ \d+h1v1h-1z")
# a figure, as against a number of one digit, a name or a power
FIGURE = re.compile(r"(?<![\w.^])-?(?:\d+\.\d+(?:e-?\d+)?|\d+e-?\d+|\d\d+|\d+(?= %))(?![\w.]*\w)")
# numbers that are places in the papers, in the page or in the calendar
CITATION = re.compile(
    r"\b(?:results?|remarks?|theorems?|propositions?|corollary|lemma|sections?|[Ff]igures?|[Ee]xamples?|annex|decision|step)\s\d+(?:\.\d+)*"
    r"(?:(?:, | and | or |–)\d+(?:\.\d+)*)*|\b(?:P|Y|M|S)\d+(?:\.\d+)*(?:\s§?\d+(?:–\d+)?)?|\[\d+\]|\((?:\d+[a-z]?|55)\)|\b(?:19|20)\d\d\b|§\d+(?:–§?\d+)?",
    re.I)


def short(value):
    """Two digits, as the pages write powers of ten."""
    return "0" if abs(value) < 1e-15 else f"{value:.2g}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def table(path):
    """The rows of a CSV file, without that of the units."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))[1:]


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


class Program:
    """The programs of a build, run in the root of the tree; their files go to a folder that is gone afterwards."""

    def __init__(self, build, root):
        self.build, self.root = build, root
        self.capstan = os.path.join(build, "cli", "capstan")

    def __enter__(self):
        self.place = tempfile.TemporaryDirectory()
        self.folder = self.place.name
        return self

    def __exit__(self, *_):
        self.place.cleanup()

    @functools.lru_cache(None)
    def call(self, *arguments, accept=(0, 1, 5), errors=False):
        """What capstan prints, or what it says beside that."""
        done = subprocess.run([self.capstan, *arguments], cwd=self.root, capture_output=True, text=True)
        if done.returncode not in accept:
            sys.exit(f"figures: capstan {' '.join(arguments)}: {done.returncode}\n{done.stderr}")
        return done.stderr if errors else done.stdout

    def run(self, *arguments):
        """What capstan prints, and where its files are."""
        place = os.path.join(self.folder, "-".join(re.sub(r"\W+", "_", a) for a in arguments))
        return self.call(*arguments, "-o", place), place

    @functools.lru_cache(None)
    def numbers(self, *path):
        """{name: rows of numbers} that a program of the build prints."""
        done = subprocess.run([os.path.join(self.build, *path)], capture_output=True, text=True, check=True)
        found = {}
        for line in done.stdout.splitlines():
            name, *row = line.split()
            found.setdefault(name, []).append([float(x) for x in row])
        return found

    @functools.lru_cache(None)
    def output(self, *command):
        """What a program of the build prints, `command` being its path and options."""
        path = [word for word in command if not word.startswith("--") and not word.isdigit()]
        return subprocess.run([os.path.join(self.build, *path), *command[len(path):]], capture_output=True, text=True, check=True).stdout

    def example(self, name, **changes):
        """A scene of examples/, with the values of some keys changed."""
        path = os.path.join("examples", name + ".yaml")
        if not changes:
            return path
        text = read(os.path.join(self.root, path))
        for key, value in changes.items():
            text = re.sub(rf"\b{key}: [^\s,}}]+", f"{key}: {value}", text)
        return self.file("-".join([name, *(f"{k}-{v}" for k, v in changes.items())]) + ".yaml", text)

    def file(self, name, text):
        path = os.path.join(self.folder, name)
        write(path, text)
        return path

    @functools.lru_cache(None)
    def sources(self):
        files = [os.path.join(at, name) for top in ("src", "cli", "include", "test") for at, _, names in os.walk(os.path.join(self.root, top))
                 for name in names if name.endswith((".c", ".h", ".py", ".txt"))]
        return {path: re.sub(r"\s+", " ", re.sub(r"\n \* ?", " ", read(path))) for path in files}  # comments run on

    def constant(self, where, pattern):
        """The number that the files of the sources with `where` in their path have where the pattern has a group; any white space is one blank."""
        found = {m[1] for path, text in self.sources().items() if where in path for m in re.finditer(pattern, text)}
        if len(found) != 1:
            sys.exit(f"figures: {where}: '{pattern}' is found {len(found)} times")
        return found.pop()


# ---- comparing ----

def unit_of(text):
    """Of the last digit, and how many digits there are."""
    mantissa, _, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals), len(mantissa.lstrip("-").replace(".", "").lstrip("0"))


def same(old, new):
    if NUMBER.sub("#", old) != NUMBER.sub("#", new):
        return False
    for a, b in zip(NUMBER.findall(old), NUMBER.findall(new)):
        x, y = float(a), float(b)
        unit, digits = unit_of(a)
        if abs(x - y) > (max(abs(x), abs(y)) / 3 if digits <= 2 and "." in a + b or "e" in a + b else 2 * unit) and max(abs(x), abs(y)) > 1e-12:
            return False
    return True


def colours(text):
    """Colours such as 6e8000 in letters, so that they are no numbers."""
    return re.sub(r"#[0-9a-f]{6}\b", lambda m: "#" + m[0][1:].translate(str.maketrans("0123456789", "ghijklmnop")), text)


def same_picture(old, new):
    """Numbers are pixels, to a tenth, and may be off by two: some curves show what rounding leaves, on a scale of powers of ten. Maps are made
    of pixels: a few that lie between two colours may have the other one."""
    if PIXEL.search(old):
        here, there = (len(PIXEL.findall(text)) for text in (old, new))
        if abs(here - there) > 0.01 * here:
            return False
        old, new = (re.sub(r"<path fill=\"#+\w+\" d=\"[Mhvz\d -]*\"/>\n?", "", text) for text in (old, new))
    if NUMBER.sub("#", old) != NUMBER.sub("#", new):
        return False
    return all(a == b or abs(float(a) - float(b)) <= 2 for a, b in zip(NUMBER.findall(old), NUMBER.findall(new)))


# ---- a page ----

class Page:
    """docs/NAME.md and what its module of scripts/pages says of it: FIGURES {name: function of the program -> lines}, SENTENCES [(words with {}
    for each number, function -> numbers as text)], PICTURES {name: function -> path}, GIVEN [words with numbers that the page gives]."""

    def __init__(self, program, name, module):
        self.program, self.name = program, name
        self.path = os.path.join(program.root, "docs", name + ".md")
        self.has = lambda what, none: getattr(module, what, none) if module else none
        self.statement = hasattr(module, "GIVEN")
        self.commands = 0

    def counted(self):
        counts = ((len(self.has("FIGURES", {})), "tables"), (sum(w.count("{}") for w, _ in self.has("SENTENCES", [])), "numbers in sentences"),
                  (len(self.has("PICTURES", {})), "pictures"), (self.commands, "commands"))
        return ", ".join(f"{n} {what}" for n, what in counts if n)

    def faults(self, check):
        """What is not as it should be; without `check` the page and its pictures are written instead."""
        old = read(self.path)
        faults, text = self.blocks(old)
        more, text = self.sentences(text)
        faults += more
        more, text = self.prints(text)
        faults += more
        if not check:
            write(self.path, text)
            faults = []
        faults += self.pictures(check)
        return faults + (self.unwritten(text) if self.statement else [])

    def fault(self, what, old, new):
        return f"docs/{self.name}.md, {what}:\n  page {old}\n  run  {new}"

    def blocks(self, text):
        lines, out, faults, k, figures = text.split("\n"), [], [], 0, self.has("FIGURES", {})
        used = set()
        while k < len(lines):
            out.append(lines[k])
            found = re.fullmatch(r"<!-- figures: ([\w-]+) -->", lines[k])
            k += 1
            if not found:
                continue
            end = lines.index("<!-- end -->", k)
            old, new = lines[k:end], ["", *figures[found[1]](self.program), ""]
            alike = self.has("LOOSELY", {}).get(found[1], same)
            used.add(found[1])
            if len(old) != len(new):
                faults.append(f"docs/{self.name}.md, {found[1]}: {len(old)} lines, expected {len(new)}")
            faults += [self.fault(found[1], a, b) for a, b in zip(old, new) if not alike(a, b)]
            out += new
            k = end
        return faults + [f"docs/{self.name}.md: {name} is not on the page" for name in figures if name not in used], "\n".join(out)

    def find(self, words, text):
        """Where the words are, whatever is in the place of each {}."""
        parts = [r"\s+".join(re.escape(w) for w in re.split(r"\s+", part)) for part in words.split("{}")]
        return list(re.finditer(("(" + NUMBER.pattern + ")").join(parts), text))

    def sentences(self, text):
        faults = []
        for words, function in self.has("SENTENCES", []):
            found, values = self.find(words, text), function(self.program)
            if len(found) != 1:
                faults.append(f"docs/{self.name}.md: '{words}' stands there {len(found)} times")
                continue
            values = [values] if isinstance(values, str) else values
            if len(values) != found[0].re.groups:
                sys.exit(f"figures: '{words}' has {found[0].re.groups} numbers, {len(values)} are given")
            old = found[0].group()
            spans = [found[0].span(i + 1) for i in range(len(values))]
            if not all(same(text[a:b], value) for (a, b), value in zip(spans, values)):
                faults.append(self.fault("in a sentence", re.sub(r"\s+", " ", old), ", ".join(values)))
            for (a, b), value in reversed(list(zip(spans, values))):
                text = text[:a] + value + text[b:]
        return faults, text

    def prints(self, text):
        """Commands in blocks of code, with what they print."""
        lines, faults = text.split("\n"), []
        for k, line in enumerate(lines):
            if not line.startswith("$ capstan "):
                continue
            self.commands += 1
            end = lines.index("```", k)
            said = self.program.call(*shlex.split(line)[2:], accept=(0, 1, 2, 3, 5)).split("\n")[:end - k - 1]
            if len(said) != end - k - 1 or not all(same(a, b) for a, b in zip(lines[k + 1:end], said)):
                faults.append(self.fault(line, "\n  ".join(lines[k + 1:end]), "\n  ".join(said)))
            lines[k + 1:end] = said
        return faults, "\n".join(lines)

    def pictures(self, check):
        faults = []
        for name, draw in self.has("PICTURES", {}).items():
            path = os.path.join(self.program.root, "docs", "pictures", name + ".svg")
            new, old = read(draw(self.program)), read(path) if os.path.exists(path) else ""
            if not check:
                write(path, new)
            elif old != new and not self.has("ALIKE", same_picture)(colours(old), colours(new)):
                faults.append(f"docs/pictures/{name}.svg: not what is drawn")
        shown = set(re.findall(r"\(pictures/([\w-]+)\.svg\)", read(self.path)))
        known = set(self.has("PICTURES", {}))
        return faults + [f"docs/{self.name}.md: {name}.svg is drawn by no command" for name in sorted(shown - known) if self.statement] + [
            f"docs/{self.name}.md: {name}.svg is not shown" for name in sorted(known - shown)]

    def unwritten(self, text):
        """Figures that no function writes, that cite nothing and that the page does not give."""
        hide = lambda m: re.sub(r"[^\n]", "~", m.group())  # no blank: a line that begins with some is code
        for words, _ in self.has("SENTENCES", []):
            for m in self.find(words, text):
                text = text[:m.start()] + hide(m) + text[m.end():]
        faults = []
        for words in self.has("GIVEN", []):
            spaced = r"\s+".join(re.escape(w) for w in words.split())
            if not re.search(spaced, text):
                faults.append(f"docs/{self.name}.md: '{words}' is said to be given there and is not")
            text = re.sub(spaced, hide, text)
        for pattern in (r"<!-- figures:.*?<!-- end -->", r"```.*?```", r"(?m)^ {4,}\S.*$", r"`[^`]*`", r"\]\([^)]*\)", r"\[\w+ \d+\]",
                        r"(?m)^#+ \d+\.\d+ "):
            text = re.sub(pattern, hide, text, flags=re.S if "figures" in pattern or "```" in pattern else 0)
        text = CITATION.sub(hide, text)
        for m in FIGURE.finditer(text):
            around = re.sub(r"\s+", " ", text[max(0, m.start() - 50):m.end() + 30])
            faults.append(f"docs/{self.name}.md: nothing writes the figure {m.group()} in '{around}'")
        return faults
