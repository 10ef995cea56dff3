"""Secrets of page and studio, and the proofs by which each knows the other (HMAC, RFC 2104).

The secret stands in the fragment of the address that was opened and is never sent. Page and studio
derive from it a token, which requests carry and which is worth nothing once the studio has ended,
and a key, by which each proves that it knows the secret. So a page that is still open when its
studio has gone gives nothing to another program at its port; and when its workspace is opened
again, it is given the new secret.
"""

from __future__ import annotations

import hashlib
import hmac
import secrets
from dataclasses import dataclass, field


def new_secret() -> str:
    """A text that nobody can guess."""
    return secrets.token_urlsafe(24)


def mac(key: str, text: str) -> str:
    """Code of a text under a key: HMAC-SHA256, 64 hexadecimal digits.

    Examples
    --------
    >>> mac("key", "text")[:8]
    '6afa9046'
    """
    return hmac.new(key.encode(), text.encode(), hashlib.sha256).hexdigest()


@dataclass(frozen=True)
class Secret:
    """Secret of a studio and its page, and what follows from it.

    Parameters
    ----------
    host
        Host and port as the address has them: proofs are for this place alone.
    text
        What stands in the address.
    key_before
        Key of the studio that had this workspace before, for pages of it that are still open; empty
        for none.
    is_plain
        Whether the text itself is taken as the token: browsers derive nothing on pages that others
        can reach without encryption.
    nonce
        What pages have to sign; another at each start.

    Examples
    --------
    >>> secret = Secret("127.0.0.1:8123", "known")
    >>> secret.token == mac("known", "token"), secret.is_token("other")
    (True, False)
    """

    host: str
    text: str = field(default_factory=new_secret)
    key_before: str = ""
    is_plain: bool = False
    nonce: str = field(default_factory=new_secret)

    @property
    def token(self) -> str:
        """Carried by each request of a page."""
        return mac(self.text, "token")

    @property
    def key(self) -> str:
        """Key of proofs, kept for the next start."""
        return mac(self.text, "key")

    def is_token(self, text: str) -> bool:
        """True for what a page of ours knows."""
        known = secrets.compare_digest(text.encode(), self.token.encode())
        is_text = secrets.compare_digest(text.encode(), self.text.encode())
        return known or (self.is_plain and is_text)

    def is_page_before(self, text: str) -> bool:
        """True for the proof of a page that the studio before had opened."""
        expected = mac(self.key_before, f"page {self.host} {self.nonce}")
        return bool(self.key_before) and secrets.compare_digest(text.encode(), expected.encode())

    def proofs(self, nonce: str) -> dict[str, str]:
        """Proofs for a page that the studio knows the secret, or that of the studio before."""
        signed = f"studio {self.host} {nonce}"
        before = mac(self.key_before, signed) if self.key_before else ""
        return {"nonce": self.nonce, "now": mac(self.key, signed), "before": before}
