"""The names of the files of a bundle, relative to its top folder.

```
bagit.txt, bag-info.txt, manifest-sha256.txt, tagmanifest-sha256.txt    BagIt 1.0 (RFC 8493)
data/ro-crate-metadata.json       description of the data (RO-Crate 1.2, Process Run Crate)
data/CITATION.cff                 how to cite them (Citation File Format 1.2.0)
data/study.yaml                   configuration of the latest invocation
data/results/                     a results folder: invocations/, runs/, recordings/, instances/
data/inputs.json                  the folder of the configuration in inputs/, names of files that it gives in full,
                                  and the SHA-256 of files that are left out
data/inputs/                      files that the configuration names, and local plugins
```
"""

import re

PAYLOAD = "data/"
CRATE = "data/ro-crate-metadata.json"
CITATION = "data/CITATION.cff"
STUDY = "data/study.yaml"
INPUTS = "data/inputs.json"
INPUT_FOLDER = "data/inputs"
RESULTS = "data/results"
DECLARATION = "bagit.txt"
INFO = "bag-info.txt"
MANIFEST = "manifest-sha256.txt"
TAG_MANIFEST = "tagmanifest-sha256.txt"

_INVOCATION = r"[0-9A-Za-z.-]+"
ALLOWED = re.compile(
    rf"{CRATE}|{CITATION}|{STUDY}|{INPUTS}|{INPUT_FOLDER}/.+|{RESULTS}/invocations/{_INVOCATION}\.yaml"
    rf"|{RESULTS}/runs/{_INVOCATION}\.jsonl|{RESULTS}/recordings/[0-9A-Za-z_-]+\.zip"
    rf"|{RESULTS}/instances/[0-9a-f]{{64}}\.(?:json|zip)"
)
"""Names of the files that a payload may have."""
