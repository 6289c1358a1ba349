"""The key and certificate of the server, made at the first start and kept for the next.

The certificate is self-signed, as on a controller; clients that want to recognise it find the
same one each time. The key can be read by its owner only.
"""

from __future__ import annotations

import os
import ssl
from contextlib import suppress
from datetime import UTC, datetime, timedelta
from ipaddress import ip_address
from pathlib import Path
from typing import Final

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID

from rapidsim.files import InputError

_YEARS: Final = 10


def tls_context(folder: Path) -> ssl.SSLContext:
    """Return the TLS context of a server.

    Args:
        folder: Folder of key and certificate; they are created if missing.

    Raises:
        InputError: If they cannot be made or read.
    """
    both = folder / "server.pem"
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    try:
        if not _is_valid(both):
            _write(both, _make_certificate())
        context.load_cert_chain(both)
    except (OSError, ValueError) as error:
        raise InputError(
            f"{both}: no key for TLS: {error}", "`--rws2-port off` serves without"
        ) from None
    return context


def default_folder() -> Path:
    """Return the folder for permanent data of this user's programs."""
    if os.name == "nt":
        base = os.environ.get("LOCALAPPDATA") or str(Path.home())
    else:
        base = os.environ.get("XDG_STATE_HOME") or str(Path.home() / ".local" / "state")
    return Path(base) / "rapidsim"


def _is_valid(both: Path) -> bool:
    """Whether there is a certificate that is still valid for at least a day."""
    if not both.exists():
        return False
    found = x509.load_pem_x509_certificate(both.read_bytes())
    end: datetime = found.not_valid_after_utc
    return end > datetime.now(UTC) + timedelta(days=1)


def _make_certificate() -> bytes:
    """Return a new key and a certificate for it, as PEM."""
    key = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "rapidsim")])
    now = datetime.now(UTC)
    names = [
        x509.DNSName("localhost"),
        *(x509.IPAddress(ip_address(one)) for one in ("127.0.0.1", "::1")),
    ]
    certificate = (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - timedelta(days=1))
        .not_valid_after(now + timedelta(days=365 * _YEARS))
        .add_extension(x509.SubjectAlternativeName(names), critical=False)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .sign(key, hashes.SHA256())
    )
    private: bytes = key.private_bytes(
        serialization.Encoding.PEM,
        serialization.PrivateFormat.PKCS8,
        serialization.NoEncryption(),
    )
    public: bytes = certificate.public_bytes(serialization.Encoding.PEM)
    return private + public


def _write(both: Path, content: bytes) -> None:
    """Write a file that only its owner can read, whole or not at all."""
    both.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    temporary = both.with_suffix(f".{os.getpid()}")
    handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        temporary.replace(both)
    finally:
        with suppress(FileNotFoundError):
            temporary.unlink()
