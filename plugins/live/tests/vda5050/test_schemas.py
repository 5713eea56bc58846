"""The fields of messages are those of the schemas that the VDA publishes."""

import json

import pytest
from mrpbench_live.vda5050.schemas import schema, topics_of, validator


def resolved(schema, parts):
    """A schema without references, and without what decides nothing."""
    if isinstance(schema, list):
        return [resolved(inner, parts) for inner in schema]
    if not isinstance(schema, dict):
        return schema
    if "$ref" in schema:
        return resolved(parts[schema["$ref"].rpartition("/")[2]], parts)
    kept = {
        key: resolved(value, parts) for key, value in schema.items() if key in ("items", "enum", "minimum", "maximum")
    }
    types = schema.get("type")
    kept |= {"type": sorted(types) if isinstance(types, list) else types, "format": schema.get("format")}
    if types == "object":
        kept["properties"] = {name: resolved(inner, parts) for name, inner in schema.get("properties", {}).items()}
        kept["required"] = sorted(schema.get("required", ()))
    return kept


@pytest.mark.parametrize("topic", topics_of("3.0"))
def test_the_fields_of_3_0_are_those_of_the_published_schemas(topic, shared_data):
    published = json.loads((shared_data / f"vda5050/{topic}.schema").read_text())
    ours = schema("3.0", topic)
    assert resolved(ours, ours["definitions"]) == resolved(published, published.get("definitions", {}))


@pytest.mark.parametrize(("version", "topic"), [(it, topic) for it in ("2.1", "3.0") for topic in topics_of(it)])
def test_what_lacks_a_field_is_refused_by_its_name(version, topic):
    required = schema(version, topic)["required"]
    assert all(f"'{name}'" in validator(version, topic)({}) for name in required)
