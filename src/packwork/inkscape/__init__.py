"""Objects of a drawing that is open in Inkscape, arranged where they are.

Inkscape runs the script of ``extension``, in its own Python; it hands the drawing and the ids of
what is chosen to this package, in a process with Packwork's Python, and is answered in lines of
JSON.
"""
