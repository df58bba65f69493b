"""What the program says of itself: options of its verbs, commands of its scripts."""

import re
import subprocess
import tempfile

VERBS = ["sweep", "cluster", "validate", "bench", "diagnose", "fit", "import", "transfer", "lab", "pick", "dataset",
         "observe", "manual"]


class Program:
    def __init__(self, path):
        self.path = str(path)
        self.options = {verb: self._options(verb) for verb in ["", *VERBS]}
        self.rows = self.run("manual", "--rows").stdout

    def run(self, *arguments):
        return subprocess.run([self.path, *arguments], capture_output=True, text=True, timeout=300)

    def _options(self, verb):
        """Per option whether a value follows it."""
        found = {}
        text = self.run(*([verb] if verb else []), "--help").stdout
        for line in text.splitlines():
            match = re.match(r"^  ((?:-\w,)?--?[\w-]+)(?:\{\w+\})?( [A-Z]|$|:)?", line)
            if not match:
                continue
            takes_value = bool(re.match(r"^  \S+ (?:TEXT|INT|UINT|FLOAT|NUMBER)\b", line))
            for name in match.group(1).split(","):
                found[name] = takes_value
        return found

    def commands(self):
        """(command, its arguments) as `help` in a script tells them."""
        with tempfile.NamedTemporaryFile("w", suffix=".script") as script:
            script.write("help\n")
            script.flush()
            text = self.run("--script", script.name).stdout
        found = []
        for line in text.splitlines():
            if not line.strip() or line.startswith(" "):
                continue
            verb = re.match(r"^[a-z ]+[a-z]", line).group(0)
            optional = re.findall(r"\[(\w+)=", line)
            needed = re.findall(r"\b[A-Z][A-Z_]*\b", re.sub(r"\[[^\]]*\]", "", line))
            found.append((verb, [name.lower() for name in needed] + optional))
        return found
