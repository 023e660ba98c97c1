# Writes the parts of the portable text as C++ strings: SHADERS (folder), PARTS, OUT.
set(text "// Written by embed.cmake.\n#include \"syntax.hpp\"\n\nnamespace cotan::shader_text {\n\n")
string(APPEND text "std::span<const PortablePart> portableParts()\n{\n    static constexpr PortablePart kParts[] = {\n")
foreach(part ${PARTS})
  file(READ ${SHADERS}/${part}.h content)
  string(APPEND text "        {\"${part}\", R\"portable(${content})portable\"},\n")
endforeach()
string(APPEND text "    };\n    return kParts;\n}\n\n} // namespace cotan::shader_text\n")
file(WRITE ${OUT} "${text}")
