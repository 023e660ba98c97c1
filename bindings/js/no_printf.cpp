// Two functions of the compiler's libraries that would print, and bring all of printf for it.
extern "C" {
// Where an exception meets noexcept: a trap, which the loader turns into an error.
[[noreturn]] void abort_message(const char*, ...) { __builtin_trap(); }
// Errors of dlopen, which nobody calls; emscripten exports it all the same.
void __dl_seterr(const char*, ...) {}
}
