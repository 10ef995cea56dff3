"""PDF/X-4 (ISO 15930-7): output intent, and what a file says of itself."""

from __future__ import annotations

import hashlib
from datetime import UTC, datetime
from uuid import UUID

import pikepdf
from pikepdf import Array, Dictionary, Name, String

from packwork.writers.prepress.profile import PressProfile

PDFX = "PDF/X-4"
_REGISTRY = "http://www.color.org"
_SCHEMAS = {
    "pdfxid": "http://www.npes.org/pdfx/ns/id/",
    "xmpMM": "http://ns.adobe.com/xap/1.0/mm/",
}


def put_intent(pdf: pikepdf.Pdf, profile: PressProfile, title: str) -> None:
    """Make a PDF, whose colours are inks already, a PDF/X-4 for a press.

    It says when it was made, as it has to.
    """
    embedded = pdf.make_stream(profile.data)
    embedded.N = 4
    condition = profile.condition
    intent = Dictionary(
        Type=Name.OutputIntent,
        S=Name.GTS_PDFX,
        OutputConditionIdentifier=String(condition),
        Info=String(profile.name),
        DestOutputProfile=embedded,
    )
    if condition != "Custom":
        intent.RegistryName = String(_REGISTRY)
    pdf.Root.OutputIntents = Array([intent])
    now = datetime.now(UTC).replace(microsecond=0)
    for name, space in _SCHEMAS.items():
        pikepdf.models.PdfMetadata.register_xml_namespace(space, name)
    number = UUID(bytes=hashlib.sha256(f"{title} {now}".encode()).digest()[:16])
    with pdf.open_metadata(set_pikepdf_as_editor=False) as meta:
        meta["pdfxid:GTS_PDFXVersion"] = PDFX
        meta["dc:title"] = title
        for name in ("CreateDate", "ModifyDate", "MetadataDate"):
            meta[f"xmp:{name}"] = now.isoformat()
        meta["pdf:Trapped"] = "False"
        meta["xmpMM:DocumentID"] = f"uuid:{number}"
        meta["xmpMM:VersionID"] = "1"
        meta["xmpMM:RenditionClass"] = "default"
    stamp = f"{now:D:%Y%m%d%H%M%SZ}"
    info = pdf.docinfo
    info.Title, info.CreationDate, info.ModDate = String(title), String(stamp), String(stamp)
    info.Trapped, info.GTS_PDFXVersion = Name("/False"), String(PDFX)
