"""Man pages and completions of shells, made from the program's help.

    help_pages.py PROGRAM OUT      writes OUT/man1/*.1 and OUT/completions/{frangia.bash,_frangia,frangia.fish}
"""
import dataclasses
import pathlib
import re
import subprocess
import sys


@dataclasses.dataclass
class Entry:
    """An option, a positional or a verb: its names, its value and one sentence."""

    names: list
    value: str
    text: str


@dataclasses.dataclass
class Page:
    """The help of one verb, or of the program."""

    verb: list
    summary: str
    usage: str
    groups: dict = dataclasses.field(default_factory=dict)
    footer: str = ""

    @property
    def verbs(self):
        return [entry.names[0] for entry in self.groups.get("Subcommands", [])]

    def options(self):
        return [
            entry
            for group, entries in self.groups.items()
            if group not in ("Subcommands", "Positionals")
            for entry in entries
            if entry.names[0].startswith("-")
        ]


HEAD = re.compile(r"^  (\S.*?)(?:\s{2,}(.*))?$")


def parse_entry(line):
    head, text = HEAD.match(line).groups()
    words = head.split(" ", 1)
    value = words[1] if len(words) > 1 else ""
    value = re.sub(r"\b(REQUIRED|Needs:.*|\.\.\.)", "", value).strip()
    return Entry(words[0].split(","), value, text or "")


def parse(verb, help_text):
    lines = help_text.split("\n")
    begin = next(i for i, line in enumerate(lines) if line.startswith("Usage: "))
    page = Page(verb, " ".join(lines[:begin]).strip(), lines[begin][len("Usage: ") :])
    group = None
    for i, line in enumerate(lines[begin + 1 :], begin + 1):
        if re.fullmatch(r"[A-Z][\w ,-]*:", line):
            group = page.groups.setdefault(line[:-1], [])
        elif group is not None and re.match(r"^  \S", line):
            group.append(parse_entry(line))
        elif group and re.match(r"^ {20,}\S", line):
            group[-1].text = (group[-1].text + " " + line.strip()).strip()
        elif line and not line.startswith(" "):
            page.footer = "\n".join(lines[i:]).strip()
            break
    return page


def pages_of(program, verb=()):
    """The page of a verb and those of its own verbs."""
    answer = subprocess.run([program, *verb, "--help"], capture_output=True, text=True, check=True)
    page = parse(list(verb), answer.stdout)
    pages = [page]
    for name in page.verbs:
        pages += pages_of(program, (*verb, name))
    return pages


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line.startswith((".", "'")) else line for line in text.split("\n"))


def man_page(page, version):
    name = "-".join(["frangia", *page.verb])
    out = [
        f'.TH {name.upper()} 1 "" "frangia {version}" "User commands"',
        ".SH NAME",
        f"{roff(name)} \\- {roff(page.summary.removeprefix('frangia: '))}",
        ".SH SYNOPSIS",
        f".B {roff(page.usage)}",
    ]
    for group, entries in page.groups.items():
        out.append(f".SH {group.upper()}")
        for entry in entries:
            out += [
                ".TP",
                f".B {roff(', '.join(entry.names))}" + (f" \\fI{roff(entry.value)}\\fR" if entry.value else ""),
                roff(entry.text) or "\\&",
            ]
    if page.footer:
        title, _, rest = page.footer.partition("\n")
        out += [f".SH {title.rstrip(':').upper()}", ".nf", roff(rest), ".fi"]
    if not page.verb:
        out += [
            ".SH EXIT STATUS",
            "0 success, 1 out of tolerance, 2 usage, 3 bad input, 4 a device or some of the work failed,",
            "5 the result cannot be trusted, 130 interrupted.",
        ]
    else:
        parent = "-".join(["frangia", *page.verb[:-1]])
        out += [".SH SEE ALSO", f".BR {roff(parent)} (1)"]
    return "\n".join(out) + "\n"


def bash_completion(pages):
    cases = []
    for page in pages:
        words = page.verbs + [name for entry in page.options() for name in entry.names]
        cases.append(f'    "{" ".join(page.verb)}") words="{" ".join(words)}" ;;')
    verbs = "|".join(sorted({verb for page in pages for verb in page.verbs}))
    return (
        f"""# bash completion for frangia
_frangia() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} path="" words="" i
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${{COMP_WORDS[i]}} in {verbs}) path="${{path:+$path }}${{COMP_WORDS[i]}}" ;; esac
  done
  case $path in
"""
        + "\n".join(cases)
        + """
  esac
  COMPREPLY=($(compgen -W "$words" -- "$cur"))
  [ -n "$cur" ] && [[ $cur != -* ]] && COMPREPLY+=($(compgen -f -- "$cur"))
}
complete -o filenames -F _frangia frangia
"""
    )


def quoted(text):
    return text.replace("'", "'\\''").replace("[", "(").replace("]", ")").replace(":", " ")


def zsh_completion(pages):
    out = [
        "#compdef frangia",
        "_frangia() {",
        "  local -a verbs",
        "  local path=''",
        "  local word",
        "  for word in ${words[2,CURRENT-1]}; do",
        "    case $word in",
    ]
    verbs = "|".join(sorted({verb for page in pages for verb in page.verbs}))
    out += [f'      {verbs}) path="${{path:+$path }}$word" ;;', "    esac", "  done", "  case $path in"]
    for page in pages:
        out.append(f"    '{' '.join(page.verb)}')")
        words = [f"'{entry.names[0]}:{quoted(entry.text)}'" for entry in page.groups.get("Subcommands", [])]
        words += [f"'{name}:{quoted(entry.text)}'" for entry in page.options() for name in entry.names]
        out.append("      verbs=(" + " ".join(words) + ") ;;")
    out += ["  esac", "  _describe 'frangia' verbs", "  _files", "}", '_frangia "$@"']
    return "\n".join(out) + "\n"


def fish_completion(pages):
    top = pages[0].verbs
    out = [f"set -l verbs {' '.join(top)}"]
    for page in pages:
        if len(page.verb) > 1:
            continue
        where = f"__fish_seen_subcommand_from {page.verb[0]}" if page.verb else "not __fish_seen_subcommand_from $verbs"
        for entry in page.groups.get("Subcommands", []):
            out.append(f"complete -c frangia -n '{where}' -a {entry.names[0]} -d '{fish(entry.text)}'")
        for entry in page.options():
            names = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in entry.names)
            out.append(f"complete -c frangia -n '{where}' {names} -d '{fish(entry.text)}'")
    return "\n".join(out) + "\n"


def fish(text):
    return text.replace("\\", "\\\\").replace("'", "\\'")


def main(program, folder):
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    pages = pages_of(program)
    out = pathlib.Path(folder)
    (out / "man1").mkdir(parents=True, exist_ok=True)
    (out / "completions").mkdir(exist_ok=True)
    for page in pages:
        name = "-".join(["frangia", *page.verb])
        (out / "man1" / f"{name}.1").write_text(man_page(page, version))
    (out / "completions" / "frangia.bash").write_text(bash_completion(pages))
    (out / "completions" / "_frangia").write_text(zsh_completion(pages))
    (out / "completions" / "frangia.fish").write_text(fish_completion(pages))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
