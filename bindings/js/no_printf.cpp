// Replaces two runtime functions that print, which would link all of printf.
extern "C" {
// Called when an exception leaves a noexcept function. The loader turns the trap into an error.
[[noreturn]] void abort_message(const char*, ...) { __builtin_trap(); }
// Reports errors of dlopen, which is never called; emscripten exports it anyway.
void __dl_seterr(const char*, ...) {}
}
