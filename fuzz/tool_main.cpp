// The tool's main as a function.
int cotanMain(int argc, char** argv);
#define COTAN_VERSION "fuzz"
#define COTAN_REPOSITORY ""
#define main cotanMain
#include "main.cpp"
