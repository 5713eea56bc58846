"""From a YAML file to runs.

1. `items`: the values of the file, with their locations.
2. `matrix` and `overrides`: one item tree for each point of the study.
3. `structure` (with `containers`, `references`, `scalars`, `validation`): a tree becomes a `RunConfig`.
4. `canonical` and `identity` (with `content`): the run as plain data, and its id.
5. `study` does these steps; `schema` describes the file to editors.
"""
