"""Prints from a report of ctest which tests failed and which were skipped, with the reasons: summary.py REPORT.xml"""
import collections
import re
import sys
import xml.etree.ElementTree as tree

cases = tree.parse(sys.argv[1]).getroot().findall("testcase")
skipped = collections.defaultdict(list)
failed = [case.get("name") for case in cases if case.find("failure") is not None]
for case in cases:
    text = case.findtext("system-out") or ""
    if case.find("skipped") is not None or re.search(r"\[  SKIPPED \]|^skipped: ", text, re.MULTILINE):
        found = re.search(r": Skipped\n(.+)", text) or re.search(r"^skipped: (.+)", text, re.MULTILINE)
        skipped[found.group(1).strip() if found else "no reason was given"].append(case.get("name"))
seconds = sum(float(case.get("time") or 0) for case in cases)
number = sum(len(names) for names in skipped.values())
print(f"{len(cases)} tests, {seconds:.0f} s of tests: {len(cases) - number - len(failed)} passed, {number} skipped, {len(failed)} failed")
for reason, names in sorted(skipped.items(), key=lambda item: -len(item[1])):
    print(f"  skipped, {reason}: {names[0]}" + (f" and {len(names) - 1} more" if len(names) > 1 else ""))
for name in failed:
    print(f"  failed: {name}")
