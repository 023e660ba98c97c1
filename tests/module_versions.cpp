// A module with entry points of two versions, and one that offers nothing.
extern "C" const void* versionSix() { return "6"; }
extern "C" const void* versionSeven() { return "7"; }
extern "C" const void* offersNothing() { return nullptr; }
