"""Sphinx settings of the manual. tools/manual builds it into build/manual."""

from pathlib import Path

project = "Pedicel"
author = "The Pedicel authors"
copyright = "The Pedicel authors, MPL-2.0"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "index"
language = "en"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3  # headings that can be linked to, down to the third level
suppress_warnings = ["myst.header"]
smartquotes = False  # it makes one dash of the two of an option
html_theme = "alabaster"
html_theme_options = {
    "description": "A sandbox where robots handle plants",
    "page_width": "min(1200px, 100%)",  # a narrower window cuts no line
    "sidebar_width": "250px",
    "body_max_width": "100%",
}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_show_sphinx = False
html_copy_source = False
html_math_renderer = "katex"

# KaTeX of Debian's libjs-katex draws the formulas from disk. Without it they stand as TeX.
KATEX = Path("/usr/share/javascript/katex")
if (KATEX / "katex.min.js").exists():
    html_static_path = [str(KATEX)]
    html_css_files = ["katex.min.css"]
    draw = (
        "addEventListener('load', () => { for (const e of document.querySelectorAll('.math')) {"
        " katex.render(e.textContent.trim().slice(2, -2), e,"
        " {displayMode: e.tagName == 'DIV', throwOnError: false});"
        " if (e.tagName == 'DIV') e.style.overflow = 'auto hidden'; } });"
    )
    html_js_files = ["katex.min.js", (None, {"body": draw})]


def visit_math(self, node):
    self.body.append(self.starttag(node, "span", "", CLASS="math"))
    self.body.append(self.encode("\\(" + node.astext() + "\\)") + "</span>")
    raise self.skip_node


def visit_block(self, node):
    self.body.append(self.starttag(node, "div", CLASS="math"))
    self.body.append(self.encode("\\[" + node.astext() + "\\]") + "</div>\n")
    raise self.skip_node


def setup(app):
    from docutils import nodes

    def skip(visit):
        def visitor(self, node):
            self.skip_node = nodes.SkipNode
            visit(self, node)

        return visitor

    app.add_html_math_renderer("katex", (skip(visit_math), None), (skip(visit_block), None))
