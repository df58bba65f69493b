#!/usr/bin/env python3
"""Every verb and every option of `pedicel --help` stands in the man page and in both completions, and
the man page is roff that man renders without a warning.

Usage: told_test.py PEDICEL
"""

import re
import shutil
import subprocess
import sys
import unittest


def run(*arguments):
    return subprocess.run([PEDICEL, *arguments], capture_output=True, text=True, timeout=60, check=True).stdout


def help_of(*verb):
    return run(*verb, "--help")


def options_in(text):
    """Of the lines `  -h,--help  what it does`."""
    rows = re.findall(r"^  (-[^\s:{\[]+)", text, re.MULTILINE)
    return {name for row in rows for name in row.split(",")}


def verbs():
    return re.findall(r"^  (\w+)", help_of().split("Subcommands:\n")[1].split("\n\n")[0], re.MULTILINE)


def plain(roff):
    return re.sub(r"\\f[BIR]", "", roff).replace("\\-", "-").replace("\\e", "\\").replace("\\&", "")



class Told(unittest.TestCase):
    def test_the_help_is_read(self):
        self.assertIn("diagnose", verbs())
        self.assertIn("--headless", options_in(help_of()))
        self.assertIn("-h", options_in(help_of()))
        self.assertIn("--out", options_in(help_of("diagnose")))

    def test_the_man_page_has_every_verb_with_its_options(self):
        page = run("--man-page")
        own, *sections = re.split(r"^\.SS pedicel (?=\w)", page.split(".SH NOTES")[0], flags=re.MULTILINE)
        parts = {"": own, **{text.split("\n")[0]: text for text in sections}}
        self.assertEqual(set(parts), {"", *verbs()})
        for verb, text in parts.items():
            told = {plain(word) for word in re.findall(r"\\fB(.*?)\\fR", text)}
            missing = options_in(help_of(*([verb] if verb else []))) - told
            self.assertFalse(missing, f"of pedicel {verb}")

    def test_the_man_page_says_exit_codes(self):
        self.assertIn("130 Ctrl-C", plain(run("--man-page")))

    def test_man_renders_it_without_a_warning(self):
        for command in (["mandoc", "-T", "lint", "-W", "warning"], ["groff", "-man", "-Tutf8", "-ww", "-z"]):
            if shutil.which(command[0]) is None:
                print(f"{command[0]} is missing: it was not asked")
                continue
            said = subprocess.run(command, input=run("--man-page"), capture_output=True, text=True, timeout=60)
            lines = [line for line in (said.stdout + said.stderr).splitlines() if "missing date" not in line]
            self.assertEqual(lines, [])

    def test_completions_have_every_option_of_every_verb(self):
        bash, zsh = run("--completion", "bash"), run("--completion", "zsh")
        for verb in ["", *verbs()]:
            options = options_in(help_of(*([verb] if verb else [])))
            row = re.search(rf"^        {verb or chr(39) * 2}\) choices='(.*)' ;;$", bash, re.MULTILINE)
            self.assertIsNotNone(row, f"bash: {verb}")
            self.assertFalse(options - set(row.group(1).split()), f"bash: {verb}")
            case = re.search(rf"^    {verb or '[*]'}\)\n(.*?);;$", zsh, re.MULTILINE | re.DOTALL)
            self.assertIsNotNone(case, f"zsh: {verb}")
            told = set(re.findall(r"^ +'\*?(-[^\[]+)\[", case.group(1), re.MULTILINE))
            self.assertFalse(options - told, f"zsh: {verb}")

    def test_an_unknown_shell_is_refused(self):
        said = subprocess.run([PEDICEL, "--completion", "fish"], capture_output=True, text=True, timeout=60)
        self.assertEqual(said.returncode, 2)
        self.assertIn("--completion", said.stderr)


if __name__ == "__main__":
    PEDICEL = sys.argv.pop(1)
    unittest.main()
