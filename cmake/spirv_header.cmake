# Converts a SPIR-V file to a header. SPIRV: input file. HEADER: output file. SYMBOL: name of the array.
file(READ ${SPIRV} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1u," words "${bytes}")
string(REGEX REPLACE "((0x........u,)(0x........u,)(0x........u,)(0x........u,)(0x........u,)(0x........u,))"
  "\\1\n" words "${words}")
file(WRITE ${HEADER} "inline constexpr std::uint32_t ${SYMBOL}[] = {\n${words}};\n")
