"""``packwork`` and ``python -m packwork``: the command line."""

from __future__ import annotations

# Python itself has loaded these; all else is loaded where Ctrl-C is one line.
import os
import sys

INTERRUPTED = 130


def main() -> None:
    """Run the command line; Ctrl-C while it still loads is one line too."""
    try:
        import signal

        _collect_less()
        _keep_to_own_threads()
        _look_for_no_plugins()
        _leave_working_folder()
        _log_warnings()
        from packwork.cli import app
        from packwork.cli.failure import WATCH

        try:
            with WATCH.listening():
                app()
        finally:
            # All is done and said; what is left is to take the program down.
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            _leave_garbage()
    except KeyboardInterrupt:
        sys.stderr.write("packwork: stopped before there was anything to write\n")
        _end_stopped()
    except SystemExit as end:
        if end.code == INTERRUPTED:
            _end_stopped()
        raise


def _leave_working_folder() -> None:
    """Take the working folder, which ``python -m`` looks in first, out of where modules are found.

    What lies there may come from anywhere, and a file of the name of a package that is not
    installed would be run in its place. Where this package itself lies there, it stays.
    """
    package = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))  # noqa: PTH120
    try:
        here = os.path.realpath(sys.path[0] or os.curdir)
        is_working = here == os.path.realpath(os.curdir)
    except OSError:
        return  # a folder that has been deleted holds no modules
    if is_working and not sys.flags.safe_path and here != package:
        del sys.path[0]


def _collect_less() -> None:
    """Look for garbage less often: what is loaded makes much that stays and next to none that goes.

    At Python's own threshold a tenth of the loading goes into looking through it again and again;
    at this one a run of a hundred items never does.
    """
    import gc

    gc.set_threshold(200_000)


def _keep_to_own_threads() -> None:
    """Have NumPy's linear algebra use one thread: others wait for work by keeping a core busy.

    All that takes long runs in threads of ours, as many as ``--threads`` says.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def _look_for_no_plugins() -> None:
    """Have pydantic look for no plugins: it would read what all installed packages offer."""
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")


def _leave_garbage() -> None:
    """Have Python not look for garbage on its way out: what is in memory goes with the process.

    It would take a quarter of a second.
    """
    import gc

    gc.freeze()


def _log_warnings() -> None:
    """Keep to the log what libraries warn of: a person can do nothing about it."""
    import logging

    logging.captureWarnings(True)
    logging.getLogger().addHandler(logging.NullHandler())


def _end_stopped() -> None:
    """End at once with the exit code of Ctrl-C.

    Libraries that are half loaded would print their own complaints on the way out; and where
    Ctrl-C struck inside ``exec``, as data classes call it, Python would die of the signal.
    """
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            continue
    os._exit(INTERRUPTED)


if __name__ == "__main__":
    main()
