"""A child process that reads untrusted files for its parent: see cotan_set_reader in cotan.h. The library starts it,
with the path of libcotan; it is not imported."""

import ctypes
import sys

if __name__ == "__main__":
    sys.exit(ctypes.CDLL(sys.argv[1]).cotan_reader_process())
