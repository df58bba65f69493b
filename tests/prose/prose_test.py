#!/usr/bin/python3
"""The checks of tools/prose see what they are for: each is shown a page with one fault.

Usage: prose_test.py PROGRAM
"""

import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from prose_checks import changelog, commands, examples, files, keys, links, rooms, rows, sentences, words  # noqa: E402
from prose_checks.page import Page  # noqa: E402
from prose_checks.program import Program  # noqa: E402

MANUAL = ROOT / "assets/manual"
PROGRAM = None


def page(text, path=MANUAL / "tried.md"):
    return Page(path, text)


def without_rows_of(key, path):
    """The page without the table rows that have the key in their first two cells."""
    lines = Page(path).lines
    rows = {number for number, _, cells in Page(path).rows if f"`{key}`" in " ".join(cells[:2])}
    return Page(path, "\n".join(line for n, line in enumerate(lines, 1) if n not in rows))


class Sentences(unittest.TestCase):
    def test_one_of_41_words_is_too_long(self):
        self.assertEqual(sentences.check(page("word " * 39 + "end. Short one. And another.")), [])
        faults = sentences.check(page("# Head\n\n" + "word " * 40 + "end. Short one. And another."))
        self.assertEqual([(3, "a sentence of 41 words, expected at most 40")], faults)

    def test_a_median_of_20_is_too_long(self):
        text = ("word " * 19 + "end. ").replace("word", "Word", 1)
        self.assertEqual(len(sentences.check(page(text * 3))), 1)
        self.assertEqual(sentences.check(page(text * 2 + "Short. Short. Short.")), [])

    def test_tables_code_and_formulas_are_no_sentences(self):
        text = "| a | b |\n|---|---|\n| " + "word " * 60 + "| b |\n\n```\n" + "word " * 60 + "\n```\n\n$$\n" + "x " * 60 + "\n$$\n"
        self.assertEqual(sentences.check(page(text)), [])

    def test_code_begins_a_sentence(self):
        counts = sentences.sentences(page("This is one. `tools/run` is another. $x$ is a third.\n"))
        self.assertEqual([words for _, words in counts], [3, 3, 4])

    def test_a_list_item_counts_by_itself(self):
        item = "- " + "word " * 15 + "end\n"
        self.assertEqual(sentences.check(page(item * 5)), [])


    def test_the_first_page_has_120_lines(self):
        self.assertEqual(sentences.check_first_page(page("word\n" * 120)), [])
        self.assertEqual(sentences.check_first_page(page("word\n" * 121)), [(121, "121 lines, expected at most 120")])


class Links(unittest.TestCase):
    def test_a_page_an_anchor_and_a_place_that_are_missing(self):
        text = "[a](nowhere.md) [b](effects.md#no-such) [c](effects.md#effects-of-a-plant) `engine/no_such.h` `engine/core`"
        self.assertEqual([text for _, text in links.check(page(text), ROOT)],
                         ["nowhere.md is not there", "effects.md#no-such: no heading of that name",
                          "`engine/no_such.h` is not in the tree"])


class Files(unittest.TestCase):
    def check(self, rows):
        text = "| file | holds |\n|---|---|\n" + rows
        return files.check(page(text, ROOT / "tools/prose_checks/README.md"))

    def test_files_that_are_there(self):
        rows = "| `page`, `page.py`, `*.py`, `NAME.py` | x |\n| [`.`](../README.md), `../prose` | `not_there` |\n"
        self.assertEqual(self.check(rows), [])

    def test_a_file_that_is_not(self):
        self.assertEqual(self.check("| `page` | x |\n| `pages` | x |\n"), [(4, "`pages` is not in this folder")])

    def test_other_tables_are_left_alone(self):
        text = "| law | source |\n|---|---|\n| `creep` | x |\n\n| file of `prose_checks/` | x |\n|---|---|\n| `pages` | x |\n"
        faults = files.check(page(text, ROOT / "tools/README.md"))
        self.assertEqual(faults, [(7, "`pages` is not in this folder")])


class ChangeLog(unittest.TestCase):
    def test_its_form(self):
        good = "# Change log\n\n## [Unreleased]\n\n### Added\n\n## [0.2.0] - 2026-11-27\n\n### Fixed\n\n## [0.1.0] - 2026-11-26\n"
        self.assertEqual(changelog.check(page(good)), [])
        bad = "## 0.1\n## [0.1.0] - 2026-11-26\n### Added\n### Added\n### Mended\n## [0.2.0] - 2026-11-27\n### Added\n"
        self.assertEqual([line for line, _ in changelog.check(page(bad))], [1, 4, 5, 6])


class Words(unittest.TestCase):
    def test_a_word_with_two_meanings(self):
        text = "| word | meaning |\n|---|---|\n| gap | a |\n| margin, slack | b |\n\n| word | meaning |\n|---|---|\n| slack | c |\n"
        self.assertEqual(words.check_glossary(page(text)), [(8, "slack has a meaning in line 4")])

    def test_an_old_word_on_a_page(self):
        old = words.old_words(Page(MANUAL / "glossary.md"))
        self.assertIn("leftover", old)
        self.assertNotIn("quiet", old)
        text = "A quiet page with `leftover` in code.\n\nThe leftover.\n\n| a |\n|---|\n| two Rivals |\n"
        self.assertEqual([line for line, _ in words.check(page(text), old)], [3, 7])


class Outputs(unittest.TestCase):
    def test_a_command_prints_one_thing_on_all_pages(self):
        one = page("```console\n$ pedicel a\nx\n$ pedicel b\n```\n", MANUAL / "one.md")
        two = page("Text.\n\n```console\n$ pedicel b\ny\n$ pedicel a\nz\n```\n", MANUAL / "two.md")
        self.assertEqual(commands.check_same([one, one]), [])
        self.assertEqual(commands.check_same([one, two]),
                         [(two, 6, "`pedicel a` prints something else in one.md:2")])

    def test_readme_and_tutorial_are_compared(self):
        shown = [{command for _, command, _ in commands.told(Page(file))}
                 for file in (ROOT / "README.md", MANUAL / "tutorial_diagnose.md")]
        self.assertIn("pedicel diagnose measured --out diagnosis", shown[0] & shown[1])


class Rooms(unittest.TestCase):
    ROOMS = {"plugins/simulation": {"engine/world"}, "engine/world": set()}

    def check(self, rows):
        return rooms.check(page("| room | holds | links |\n|---|---|---|\n" + rows), self.ROOMS)

    def test_the_rooms_as_they_are(self):
        self.assertEqual(self.check("| `plugins/simulation` | x | `engine/world` |\n| `engine/world` | x | |\n"), [])

    def test_a_room_that_is_missing_one_that_is_gone_and_a_link_that_is_not(self):
        self.assertEqual(self.check("| `plugins/simulation` | x | `engine/io` |\n| `app/old` | x | |\n"),
                         [(1, "the room `engine/world` is missing"),
                          (3, "`plugins/simulation` links `engine/world`"), (4, "`app/old` is no room")])

    def test_a_room_without_a_readme(self):
        self.assertEqual(rooms.check_readmes({"engine/core", "engine/nowhere"}, ROOT),
                         [(1, "the room `engine/nowhere` has no README.md")])

    def test_every_library_of_the_tree_is_found(self):
        found = rooms.rooms_of(ROOT)
        self.assertGreater(len(found), 30)
        self.assertIn("plugins/plant", found["plugins/skeleton"])
        self.assertIn("plugins/cosserat/laws", found["plugins/cosserat/model"])
        self.assertNotIn("app/python", found)  # a module


class Keys(unittest.TestCase):
    def test_every_key_that_is_taken_off_its_page_is_missed(self):
        for rule in keys.RULES:
            for source, found in keys.groups(rule, ROOT):
                for key in found:
                    with self.subTest(source=source, key=key):
                        faults = keys.check(rule, without_rows_of(key, MANUAL / rule.page), ROOT)
                        self.assertIn(f"`{key}` of {source} is missing", [text for _, text in faults])

    def test_a_key_of_one_section_is_missed_though_another_one_has_it(self):
        lines = Page(MANUAL / "plant_file.md").lines
        fruit = lines.index("## A fruit")
        radius = next(n for n, line in enumerate(lines) if n > fruit and line.startswith("| `radius`"))
        model = "plugins/plant/model/plant_model.h"
        rule = next(rule for rule in keys.RULES if rule.page == "plant_file.md" and model in rule.sources)
        cut = Page(MANUAL / "plant_file.md", "\n".join(lines[:radius] + lines[radius + 1:]))
        self.assertEqual(keys.check(rule, cut, ROOT),
                         [(1, f"`radius` of {model} is missing")])

    def test_a_rule_that_finds_too_little_says_so(self):
        rule = keys.Rule("plant_file.md", ("plugins/plant/plant_size.cpp",), keys.READER, 5)
        self.assertIn("no longer fits", keys.check(rule, Page(MANUAL / rule.page), ROOT)[0][1])
        moved = keys.Rule("plant_file.md", ("plugins/plant/moved.cpp",), keys.READER, 5)
        self.assertIn("is not there", keys.check(moved, Page(MANUAL / rule.page), ROOT)[0][1])


class Commands(unittest.TestCase):
    def check(self, line):
        return [text for _, text in commands.check_lines(page(f"```console\n$ {line}\n```\n"), PROGRAM, ROOT)]

    def test_lines_that_parse(self):
        for line in ["pedicel", "pedicel bench --threads 2", "pedicel a.yaml --set x=1 --no-video",
                     "pedicel diagnose folder --json", "cmake --preset release", "tools/test -R Coupling"]:
            self.assertEqual(self.check(line), [], line)

    def test_lines_that_do_not(self):
        self.assertEqual(self.check("pedicel bench --thread 2"), ["--thread is no option of pedicel bench"])
        self.assertEqual(self.check("pedicel diagnose --json"), ["pedicel diagnose lacks what it works on"])
        self.assertEqual(self.check("pedicel a.yaml --set"), ["--set lacks its value"])
        self.assertEqual(self.check("tools/no_such_tool"), ["tools/no_such_tool is not in the tree"])

    def test_an_option_a_command_an_argument_or_a_code_that_is_not_told(self):
        told = MANUAL / "command_line.md"
        missing = commands.check_options(without_rows_of("--worlds", told), PROGRAM)
        self.assertEqual([text for _, text in missing], ["--worlds of pedicel bench is missing"])
        codes = page(told.read_text(encoding="utf-8").replace("| 77 |", "| 7 |"))
        self.assertEqual(commands.check_exit_codes(codes, PROGRAM), [(1, "exit code 77 is missing")])
        scripts = MANUAL / "scripts.md"
        self.assertEqual(commands.check_script_commands(without_rows_of("add fruit", scripts), PROGRAM),
                         [(1, "command `add fruit` is missing")])
        text = scripts.read_text(encoding="utf-8").replace("`torsion`", "torsion")
        self.assertEqual(commands.check_script_commands(page(text), PROGRAM),
                         [(1, "argument `torsion` of command `add fruit` is missing")])

    def test_an_example_that_the_program_refuses(self):
        plant = (MANUAL / "plant_file.md").read_text(encoding="utf-8")
        self.assertEqual(examples.check(page(plant), PROGRAM), [])
        faults = examples.check(page(plant.replace("density: 700", "density: -700")), PROGRAM)
        self.assertIn("this file is refused", faults[0][1])


if __name__ == "__main__":
    PROGRAM = Program(sys.argv.pop(1))
    unittest.main()
