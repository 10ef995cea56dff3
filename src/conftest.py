"""Doctests of the adapters run where the packages they bridge to are installed."""

from importlib.util import find_spec

collect_ignore_glob = [] if find_spec("torch") else ["packwork/adapters/torch.py"]
