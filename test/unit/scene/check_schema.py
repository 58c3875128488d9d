#!/usr/bin/python3
"""Usage: check_schema.py SCHEMA FILE...

Prints a line per file: "ok" if it is JSON (comments allowed) that conforms to the schema, otherwise "bad: <why>".
Runs with the system's Python, for which scripts/install-dependencies installs jsonschema.
"""

import json
import math
import re
import sys

import jsonschema

STRING_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def refuse(constant):
    raise ValueError(f"{constant} is no JSON")


def finite(text):
    number = float(text)
    return number if math.isfinite(number) else refuse(text)


def parse(text):
    plain = STRING_OR_COMMENT.sub(lambda match: match[0] if match[0][0] == '"' else " ", text)
    return json.loads(plain, parse_constant=refuse, parse_float=finite)


check_reference, known = jsonschema.Draft202012Validator.VALIDATORS["$ref"], set()


def check_once(validator, name, instance, schema):
    """Checks a value by a part of the schema once: most values of the files are equal, and validation is slow."""
    key = (name, json.dumps(instance))
    if key not in known:
        errors = list(check_reference(validator, name, instance, schema))
        if not errors:
            known.add(key)
        yield from errors


def verdict(validator, file):
    try:
        with open(file, encoding="utf-8") as content:
            document = parse(content.read())
    except ValueError as error:
        return f"bad: {error}"
    error = next(validator.iter_errors(document), None)  # finding the best of all errors takes much longer
    return "ok" if error is None else f"bad: {error.json_path}: {error.message}"


def main(schema_file, files):
    with open(schema_file, encoding="utf-8") as content:
        schema = json.load(content)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.validators.extend(jsonschema.Draft202012Validator, {"$ref": check_once})(schema)
    for file in files:
        print(verdict(validator, file).replace("\n", " "))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
