"""Sphinx settings of the manual. tools/manual builds it into build/manual."""

project = "Pedicel"
author = "The Pedicel authors"
copyright = "The Pedicel authors, MPL-2.0"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "index"
myst_enable_extensions = ["dollarmath"]
# Every heading down to the third level can be linked to.
myst_heading_anchors = 3
html_theme = "alabaster"
html_theme_options = {
    "description": "A sandbox where robots handle plants",
    "fixed_sidebar": True,
    "page_width": "1100px",
    "sidebar_width": "240px",
}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
# Pages name no clock, so that two builds of one tree are the same.
html_last_updated_fmt = None
html_show_sphinx = False
html_copy_source = False
# Formulas stand as their TeX text, which needs nothing from the network: see tools/manual.
html_math_renderer = "mathjax"
