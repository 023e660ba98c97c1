"""A child process that reads files for its parent, which may be broken: see cotan_set_reader in cotan.h. Started by the
library with the path of libcotan, not imported."""

import ctypes
import sys

if __name__ == "__main__":
    sys.exit(ctypes.CDLL(sys.argv[1]).cotan_reader_process())
