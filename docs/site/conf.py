"""Settings of the documentation as a site: Sphinx with MyST over the Markdown files of the source tree.

tools/build_site lays the pages out as the repository does, so that links between them work in both.
"""

project = "Recoil"
author = copyright = "the Recoil developers"  # Sphinx's name for it
extensions = ["myst_parser"]
root_doc = "index"
exclude_patterns = ["README.md", "docs/site/**"]  # their text stands on the first page
myst_heading_anchors = 3  # links such as theory.md#walls, as forges resolve them

html_theme = "furo"
html_title = "Recoil"
html_static_path = ["style.css"]
html_css_files = ["style.css"]
html_copy_source = False
html_show_sphinx = False
highlight_language = "none"

# Folders whose pages are listed below their README, so that no list has to be kept there.
LISTED = {"docs/decisions/README": "*", "docs/changes/README": "*", "cases/README": "*/README"}


def add_list(_app, name, source):
    if name in LISTED:
        source[0] += f"\n```{{toctree}}\n:glob:\n:maxdepth: 1\n\n{LISTED[name]}\n```\n"


def setup(app):
    app.connect("source-read", add_list)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
