"""Streams for fuzz/make-seeds in base64, made once with the encoders of the libraries: the square of class Gltf with
Draco 1.5.5 and meshoptimizer 0.18, small images with libwebp 1.2.4."""
import base64

_TEXT = {
    "draco_sequential":
        "RFJBQ08CAgEAAAACBAEAAQIAAgMBAgAJAwAAAwkCAAECAgABAQADAwEwARADADSCiAQAAAAA/z8AAAABAQADAwEgASADACCEhgIA"
        "AAAA/w8AAAAAAAAAAAAAAAAAAAAAgD8OAAAAAAAAAAAAAIA/DA==",
    "draco_edgebreaker":
        "RFJBQ08CAgEBAAAABAIBAgAAAR//ARH/AREC/wAAAAAAAQAJAwAAAgEDCQIAAQIBAQEAAwMBMAEQAwAogpgAAAAAAP8/AAAAAAAA"
        "AAAAAAAAAAAAAIA/DgEBAQADAwEgASADAPCDpgAAAAAA/w8AAAAAAAAAAAAAAACAPww=",
    "meshopt_positions":
        "oAAAATMAAAD//wEzAAAAfn0AAAEMAAAA/wEMAAAAfgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA==",
    "meshopt_triangles":
        "4PAAAHaHVmd4qYZliWiYAWkAAA==",
    "meshopt_indices":
        "0AAEBAYIBAAAAAA=",
    "meshopt_octahedral":
        "oAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAfQGF/f8HAAA=",
    "meshopt_exponential":
        "oAABMwAAAEA/AAEgAAAAAAEMAAAAQAABIAAAAAAAAAEgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADyAAAA8gAAAPI=",
    "meshopt_quaternion":
        "oAE/AAAAQkRCASoAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAEMCnPz/Bw==",
    "webp_lossy_alpha":
        "UklGRnAAAABXRUJQVlA4WAoAAAAQAAAADwAABwAAQUxQSBcAAAABmYzof4BM2qZUSf0b3bU/YgImgFpzBwBWUDggMgAAALABAJ0B"
        "KhAACAACwEwlqAJ0AQ6nTAAA/T7NcRPn/mbdf8wX/yi57v7Ja79pKu5noAAA",
    "webp_lossy":
        "UklGRlQAAABXRUJQVlA4IEgAAABQAgCdASoIAAgAAsBMJbACdEf/7gACMC/8QwAA/opCivke16tvy/5HmsVf3CVUgn88TF0n+y0T"
        "203q9dftpW4vnJ9/JxRAAAA=",
    "webp_lossless":
        "UklGRjoAAABXRUJQVlA4TC4AAAAvD8ABEM1kRP9jE1Hw/gcUtG3DBHrZvw2AQCCFZ/D8CWRTvE7SBJAkYOoDl/0e",
}
STREAMS = {name: base64.b64decode(text) for name, text in _TEXT.items()}
