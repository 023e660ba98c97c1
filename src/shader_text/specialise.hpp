// What is done to the tree before it is printed: constants put in the place of arguments that are known, branches
// decided, what is left over dropped; and structs taken apart for a language without them.
#pragma once

#include "syntax.hpp"

namespace cotan::shader_text {

// Puts `value` in the place of parameter `name` of `function` (of its field `field` unless that is
// empty). A parameter without a field goes from the function and from all calls.
void bindArgument(Module& module, const std::string& function, const std::string& name, const std::string& field,
                  const std::string& value);

// Takes a parameter whose fields are all bound out of the function; its calls are not changed.
void dropParameter(Module& module, const std::string& function, const std::string& name);

// Decides comparisons of numbers, selects and ifs that hang on them, factors of 1 and -1; joins a
// declaration with the assignment that follows; drops variables that nothing reads.
void simplify(Function& function);

// What the functions named in `roots` need, in the module's order; structs too.
Module neededBy(const Module& module, const std::vector<std::string>& roots);

// Each variable of a struct becomes one variable for each field, NAME_FIELD; parameters too. A function that returns a
// struct returns nothing and has `out` parameters behind its others.
// Throws std::runtime_error where a struct hangs on ?: or a name is taken.
Module withoutStructs(const Module& module);

} // namespace cotan::shader_text
