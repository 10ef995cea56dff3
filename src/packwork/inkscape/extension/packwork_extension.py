"""Extensions of Inkscape: objects fill a shape, words fill one, parts are nested.

Inkscape runs this file in its own Python. The work is done by Packwork in another Python, whose
path ``packwork inkscape install`` writes into ``packwork_python.txt`` beside this file.
"""

import json
import os
import subprocess
import threading
import warnings
from pathlib import Path

import inkex
import inkex.command

LENGTHS = ("gap", "margin")


class PackworkExtension(inkex.EffectExtension):
    """Asks Packwork and carries out what it answers."""

    def add_arguments(self, pars):
        """Name what the three dialogues ask."""
        pars.add_argument("--tab")
        pars.add_argument("--verb")
        pars.add_argument("--unit", default="mm")
        pars.add_argument("--container", default="")
        pars.add_argument("--on", default="page")
        pars.add_argument("--text", default="")
        pars.add_argument("--file", default="")
        for name in ("gap", "margin", "time"):
            pars.add_argument(f"--{name}", type=float)
        for name in ("seed", "count"):
            pars.add_argument(f"--{name}", type=int)
        pars.add_argument("--mirror", type=inkex.Boolean)
        for name in ("sizes", "rotate", "effort", "font", "palette"):
            pars.add_argument(f"--{name}")

    def effect(self):
        """Ask, and change the document at once, so that one step back undoes it."""
        chosen = list(self.svg.selection.rendering_order().values())
        request = getattr(self, f"_{self.options.verb}")(chosen)
        request["verb"], request["drawing"] = self.options.verb, self._drawing(chosen)
        answer = Child(request).answer()
        if answer is None:
            return
        if "error" in answer:
            raise inkex.AbortExtension(answer["error"])
        for name, transform in answer["transforms"].items():
            # Their ``set`` keeps six digits, and nothing of a map that changes nothing.
            self.svg.getElementById(name).attrib["transform"] = transform
        if answer["new"]:
            self._add(answer["new"])
        for line in answer["remarks"]:
            inkex.errormsg(line)

    def _fill(self, chosen):
        ground = self._container(chosen)
        names = [one.get_id() for one in chosen if one is not ground]
        if not names:
            raise inkex.AbortExtension("Choose a shape and the objects that are to fill it.")
        return {
            "container": ground.get_id(),
            "objects": names,
            "options": self._options("sizes", "rotate", "effort", "seed", padding="gap"),
        }

    def _words(self, chosen):
        ground = self._container(chosen)
        texts = [text_of(one) for one in chosen if one is not ground]
        text = " ".join([*filter(None, texts), self.options.text.replace("\\n", " ")]).strip()
        if Path(self.options.file).is_file():
            text = Path(self.options.file).read_text(encoding="utf-8", errors="replace")
        if not text:
            raise inkex.AbortExtension("Choose a shape, and a text beside it; or write words.")
        layer = self.svg.get_current_layer()
        return {
            "container": ground.get_id(),
            "parent": None if layer is self.svg else layer.get_id(),
            "text": text,
            "options": self._options(
                "count", "rotate", "font", "palette", "effort", "seed", padding="gap"
            ),
        }

    def _nest(self, chosen):
        ground = None
        if self.options.container or self.options.on == "lowest":
            ground = self._container(chosen)
        names = [one.get_id() for one in chosen if one is not ground]
        if not names:
            raise inkex.AbortExtension("Choose the objects that are to be nested.")
        return {
            "container": None if ground is None else ground.get_id(),
            "page": [*self.svg.get_viewbox()[:2], self.svg.viewbox_width, self.svg.viewbox_height],
            "objects": names,
            "options": self._options("rotate", "mirror", "margin", "time", "seed", kerf="gap"),
        }

    def _container(self, chosen):
        """The object of the name that was given, else the lowest that is chosen."""
        name = self.options.container.strip()
        if name:
            for one in self.svg.iter():
                if isinstance(one, inkex.ShapeElement) and name in (one.label, one.get("id")):
                    return one
            raise inkex.AbortExtension(f"No object is called {name}.")
        if not chosen:
            raise inkex.AbortExtension("Nothing is chosen: choose a shape, and what is to fill it.")
        return chosen[0]

    def _options(self, *names, **renamed):
        renamed = {**dict.fromkeys(names), **renamed}
        found = {to: getattr(self.options, name or to) for to, name in renamed.items()}
        for to, name in renamed.items():
            if (name or to) in LENGTHS and found[to] is not None:
                found[to] = self.svg.viewport_to_unit(f"{found[to]}{self.options.unit}")
        return {to: value for to, value in found.items() if value not in (None, "")}

    def _drawing(self, chosen):
        """The document's text, letters in it as the outlines that Inkscape draws."""
        whole = self.svg.tostring().decode()
        is_text = any(
            isinstance(part, (inkex.TextElement, inkex.FlowRoot))
            for one in chosen
            for part in (one, *one.iterdescendants(), *linked(one))
        )
        if not is_text or self.options.verb == "words":
            return whole
        folder = Path(self.options.input_file).parent
        plain = folder / f"{Path(self.options.input_file).stem}-outlines.svg"
        inkex.command.inkscape(
            self.options.input_file,
            export_text_to_path=True, export_plain_svg=True, export_filename=str(plain),
        )  # fmt: skip
        try:
            return plain.read_text(encoding="utf-8")
        finally:
            plain.unlink()

    def _add(self, new):
        group = inkex.Group.new("Words")
        self.svg.get_current_layer().add(group)
        for label, markup, transform in new:
            one = inkex.load_svg(
                f'<svg xmlns="{inkex.NSS["svg"]}"><g transform="{transform}">{markup}</g></svg>'
            ).getroot()[0]
            one.label = label
            group.add(one)


def text_of(element):
    """Characters of a text object, lines apart; empty for anything else."""
    if not isinstance(element, (inkex.TextElement, inkex.FlowRoot)):
        return ""
    return " ".join(piece for piece in element.itertext() if piece.strip())


def linked(element):
    """The object that a clone shows."""
    return (element.href,) if isinstance(element, inkex.Use) and element.href is not None else ()


class Child:
    """Packwork at work on one request, with a window that shows how far it is, where one can be."""

    def __init__(self, request):
        python = Path(__file__).with_name("packwork_python.txt")
        if not python.is_file():
            raise inkex.AbortExtension("Packwork is not set up: run  packwork inkscape install")
        path = python.read_text(encoding="utf-8").strip()
        try:
            self.process = subprocess.Popen(  # noqa: S603 - what was installed
                [path, "-m", "packwork.inkscape"],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                env=clean_environment(),
            )  # fmt: skip
        except OSError as error:
            raise inkex.AbortExtension(
                f"Packwork is no longer at {path}: run  packwork inkscape install"
            ) from error
        self.request = request
        self.last = {}
        self.cancelled = False

    def answer(self):
        """The last line of the answer; None if the person cancelled."""
        window = ProgressWindow.open(self)
        if window is None:
            self._listen(lambda share: None)
        else:
            window.run(self._listen)
        if self.cancelled:
            return None
        if not {"error", "transforms"} & self.last.keys():
            raise inkex.AbortExtension(self.complaint or "Packwork ended without an answer.")
        return self.last

    def cancel(self):
        """End the work; the document stays as it is."""
        self.cancelled = True
        self.process.kill()

    def _listen(self, tell):
        heard = []
        reader = threading.Thread(target=lambda: heard.append(self.process.stderr.read()))
        reader.start()
        try:
            self.process.stdin.write(json.dumps(self.request).encode())
            self.process.stdin.close()
        except BrokenPipeError:
            pass  # its complaint says why
        for line in self.process.stdout:
            self.last = json.loads(line)
            if "progress" in self.last:
                tell(self.last["progress"])
        self.process.wait()
        reader.join()
        self.process.stdout.close()
        self.process.stderr.close()
        self.complaint = heard[0].decode(errors="replace").strip()


def clean_environment():
    """Environment without what Inkscape tells its own Python."""
    own = ("PYTHONPATH", "PYTHONHOME", "GI_TYPELIB_PATH", "LD_LIBRARY_PATH")
    return {key: value for key, value in os.environ.items() if key not in own}


class ProgressWindow:
    """A bar and a button to cancel."""

    @classmethod
    def open(cls, child):
        """The window; None where there is no screen."""
        try:
            with warnings.catch_warnings():
                # Whatever is printed, Inkscape shows in a window.
                warnings.simplefilter("ignore")
                import gi

                gi.require_version("Gtk", "3.0")
                from gi.repository import GLib, Gtk

            if not Gtk.init_check(None)[0]:
                return None
        except (ImportError, ValueError):
            return None
        return cls(child, Gtk, GLib)

    def __init__(self, child, gtk, glib):
        self.gtk, self.glib = gtk, glib
        self.bar = gtk.ProgressBar(show_text=True, margin=18)
        self.bar.set_size_request(320, -1)
        self.bar.set_text("Packwork starts")
        dialog = self.dialog = gtk.Dialog(title="Packwork")
        dialog.set_keep_above(True)
        dialog.set_position(gtk.WindowPosition.CENTER)
        dialog.add_button("Cancel", gtk.ResponseType.CANCEL)
        dialog.get_content_area().add(self.bar)
        dialog.connect("response", lambda *_: child.cancel())
        dialog.show_all()

    def run(self, work):
        """Do the work beside the window, which closes at its end."""

        def tell(share):
            self.glib.idle_add(self._show, share)

        def whole():
            try:
                work(tell)
            finally:
                self.glib.idle_add(self.gtk.main_quit)

        thread = threading.Thread(target=whole)
        thread.start()
        self.gtk.main()
        thread.join()
        self.dialog.destroy()

    def _show(self, share):
        self.bar.set_fraction(share)
        self.bar.set_text(f"{share:.0%}")


if __name__ == "__main__":
    PackworkExtension().run()
