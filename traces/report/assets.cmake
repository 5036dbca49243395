# SPDX-License-Identifier: Apache-2.0
# cmake -DOUT=FILE -DSTYLE=FILE -DSCRIPT=FILE -DCHARTS=FILE -P assets.cmake: writes the source of assets.hpp's texts.
set(text "#include \"traces/report/assets.hpp\"\n\nnamespace parallax {\n")
foreach(asset kReportStyle:STYLE kReportScript:SCRIPT kChartLibrary:CHARTS)
  string(REPLACE ":" ";" asset ${asset})
  list(GET asset 0 name)
  list(GET asset 1 variable)
  file(READ "${${variable}}" content HEX)
  string(REGEX REPLACE "(..)" "\\\\x\\1" content "${content}")
  # A line of the file per literal would let an escape run into the next character; pieces of hex do not.
  string(REGEX REPLACE "(................................................................................)" "\\1\"\n  \"" content "${content}")
  string(APPEND text "const std::string_view ${name} =\n  \"${content}\";\n")
endforeach()
file(WRITE "${OUT}" "${text}}\n")
