"""Holds JSON documents to the published schema of a report: schema_check.py SCHEMA FILE.., with
jsonschema where it is there, and always with a small reader of the words that these schemas have.
Here a key that the schema does not name is a fault as well. SCHEMA --sins FILE instead says whether
each of some small changes to the file is found."""
import copy
import json
import sys

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}


def is_type(value, name):
    if name == "number":
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    return isinstance(value, TYPES[name])


def faults(schema, value, root, where="$"):
    if "$ref" in schema:
        return faults(root["$defs"][schema["$ref"].rsplit("/", 1)[1]], value, root, where)
    found = []
    if "oneOf" in schema:
        tried = [faults(one, value, root, where) for one in schema["oneOf"]]
        if sum(not one for one in tried) != 1:
            found += min(tried, key=len) or [f"{where}: fits several"]
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if kinds and not any(is_type(value, kind) for kind in kinds):
        return found + [f"{where}: {value!r} is not of {kinds}"]
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{where}: {value!r} is not one of {schema['enum']}")
    if isinstance(value, dict) and ("properties" in schema or "additionalProperties" in schema):
        known = schema.get("properties", {})
        found += [f"{where}: no {key}" for key in schema.get("required", []) if key not in value]
        for key, one in value.items():
            other = schema.get("additionalProperties")
            if key not in known and other is None:
                found.append(f"{where}.{key}: the schema does not name it")
            else:
                found += faults(known.get(key, other), one, root, f"{where}.{key}")
    if isinstance(value, list):
        if len(value) < schema.get("minItems", 0):
            found.append(f"{where}: too few")
        for index, one in enumerate(value):
            found += faults(schema.get("items", {}), one, root, f"{where}[{index}]")
    return found


def sins(value, path=()):
    """Copies of a document, each with a small fault: a key too many, one too few, a wrong type."""
    if isinstance(value, dict) and value:
        yield path, {**value, "no_such_key": 1}
    for key, one in list(value.items() if isinstance(value, dict) else enumerate(value[:1])):
        if isinstance(one, (dict, list)):
            for at, wrong in sins(one, (*path, key)):
                changed = copy.copy(value)
                changed[key] = wrong
                yield at, changed
        else:
            changed = copy.copy(value)
            changed[key] = {"wrong": []}
            yield (*path, key), changed


def main():
    schema = json.load(open(sys.argv[1], encoding="utf-8"))
    if sys.argv[2] == "--sins":
        whole = json.load(open(sys.argv[3], encoding="utf-8"))
        missed = [path for path, wrong in sins(whole) if not faults(schema, wrong, schema)]
        for path in missed:
            print(f"not found: {path}")
        return len(missed)
    try:
        import jsonschema
    except ImportError:
        jsonschema = None
    wrong = 0
    for name in sys.argv[2:]:
        value = json.load(open(name, encoding="utf-8"))
        found = faults(schema, value, schema)
        if jsonschema:
            found += [error.message for error in
                      jsonschema.validators.validator_for(schema)(schema).iter_errors(value)]
        for fault in found:
            print(f"{name}: {fault}")
        wrong += bool(found)
    return wrong


sys.exit(min(main(), 100))
