// Hands errors on. Both macros return from the function that they stand in.
#pragma once

// Declares the Result `name` of an expression; returns its error if it has one. `*name` is the value afterwards.
#define COTAN_TRY(name, ...)                                                                                           \
    auto name = __VA_ARGS__;                                                                                           \
    if (!name)                                                                                                         \
    return name.error()

// Evaluates an expression that gives a Result without a value of interest; returns its error if it has one.
#define COTAN_CHECK(...)                                                                                               \
    do {                                                                                                               \
        if (auto status_ = __VA_ARGS__; !status_)                                                                      \
            return status_.error();                                                                                    \
    } while (false)
