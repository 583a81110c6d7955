#!/usr/bin/env python3
"""Holds the files of docker/ against their schemas: manifests_test.py [SCRATCH FOLDER]
The compose file by docker-compose; the Kubernetes objects, unknown fields too, by the types of the npm
package kubernetes-models where a scratch folder for npm is given; always: what the pod security
standard "restricted" asks, that names refer to something, that alerts ask for metrics there are."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from cluster import skip

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCKER = ROOT / "docker"
PACKAGES = ["kubernetes-models@5.1.0", "typescript@5.4.5"]
SCRATCH = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else None

try:
    import yaml
except ImportError:
    skip("there is no yaml for Python (package python3-yaml)")


def objects():
    """All of docker/kubernetes, with the file that each is in."""
    for path in sorted((DOCKER / "kubernetes").rglob("*.yaml")):
        if path.name == "kustomization.yaml":
            continue
        for one in yaml.safe_load_all(path.read_text()):
            yield path.relative_to(ROOT), one


def pods():
    for path, one in objects():
        if one["kind"] in ("Deployment", "StatefulSet", "Job"):
            yield f"{path}: {one['kind']}", one["spec"]["template"]


def run(*words, **more):
    return subprocess.run(words, capture_output=True, text=True, **more)


class Manifests(unittest.TestCase):
    def skip_part(self, why, required=False):
        """Skips one test and prints why; fails where it is required under CI=true."""
        if required and os.environ.get("CI") == "true":
            self.fail(why)
        print(f"\nSKIPPED: {why}", flush=True)
        self.skipTest(why)

    def test_the_compose_file(self):
        if not shutil.which("docker-compose"):
            self.skip_part("there is no docker-compose", required=True)
        done = run("docker-compose", "-f", str(DOCKER / "compose.yaml"), "config", cwd=DOCKER)
        self.assertEqual(done.returncode, 0, done.stderr)
        services = yaml.safe_load(done.stdout)["services"]
        self.assertEqual(set(services), {"proxy", "renderer", "store", "prometheus"})
        for name, one in services.items():
            with self.subTest(name):
                self.assertTrue(one["read_only"])
                self.assertEqual(one["cap_drop"], ["ALL"])
                self.assertEqual(one["security_opt"], ["no-new-privileges:true"])
                self.assertEqual(one["restart"], "unless-stopped")
                self.assertNotIn(one.get("user", "").split(":")[0], ("0", "root"))
                for limit in ("mem_limit", "pids_limit", "cpus"):
                    self.assertIn(limit, one)
        wrong = (DOCKER / "compose.yaml").read_text().replace("pids_limit: 256", "pid_limit: 256")
        done = run("docker-compose", "-f", "-", "config", cwd=DOCKER, input=wrong)
        self.assertNotEqual(done.returncode, 0, "an unknown field is not seen")

    def test_the_proxy(self):
        if not shutil.which("haproxy"):
            self.skip_part("there is no haproxy", required=True)
        values = {"FAROL_BIND": "*", "FAROL_RENDERERS": "localhost", "FAROL_SLOTS": "2"}
        done = run("haproxy", "-c", "-f", str(DOCKER / "haproxy.cfg"),
                   env={**os.environ, **values})
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        self.assertNotIn("WARNING", done.stderr)

    def test_pods_are_restricted(self):
        """kubernetes.io/docs/concepts/security/pod-security-standards, "Restricted", and more."""
        found = list(pods())
        self.assertEqual(len(found), 4)
        for name, template in found:
            spec = template["spec"]
            with self.subTest(name):
                self.assertFalse(spec["automountServiceAccountToken"])
                self.assertTrue(spec["securityContext"]["runAsNonRoot"])
                self.assertGreater(spec["securityContext"]["runAsUser"], 0)
                self.assertEqual(spec["securityContext"]["seccompProfile"]["type"],
                                 "RuntimeDefault")
                for field in ("hostNetwork", "hostPID", "hostIPC"):
                    self.assertNotIn(field, spec)
                for volume in spec["volumes"] if "volumes" in spec else []:
                    kinds = set(volume) - {"name"}
                    self.assertLessEqual(kinds, {"emptyDir", "configMap", "secret",
                                                 "persistentVolumeClaim"})
                for one in spec["containers"]:
                    context = one["securityContext"]
                    self.assertEqual(context["capabilities"], {"drop": ["ALL"]})
                    self.assertFalse(context["allowPrivilegeEscalation"])
                    self.assertTrue(context["readOnlyRootFilesystem"])
                    self.assertNotIn("privileged", context)
                    self.assertIn("memory", one["resources"]["limits"])
                    self.assertIn("cpu", one["resources"]["requests"])

    def test_names_refer_to_something(self):
        """Selectors select a pod, ports have their names, volumes are there, scaling has a target."""
        labels = [template["metadata"]["labels"] for _, template in pods()]

        def selects(wanted):
            return any(wanted.items() <= one.items() for one in labels)

        names = {(one["kind"], one["metadata"]["name"]) for _, one in objects()}
        for path, one in objects():
            kind, spec = one["kind"], one.get("spec", {})
            with self.subTest(f"{path}: {kind} {one['metadata']['name']}"):
                if kind == "Service":
                    self.assertTrue(selects(spec["selector"]))
                    ports = {port["name"] for _, template in pods()
                             if spec["selector"].items() <= template["metadata"]["labels"].items()
                             for c in template["spec"]["containers"] for port in c["ports"]}
                    for port in spec["ports"]:
                        self.assertIn(port["targetPort"], ports)
                if kind in ("Deployment", "StatefulSet"):
                    self.assertLessEqual(spec["selector"]["matchLabels"].items(),
                                         spec["template"]["metadata"]["labels"].items())
                if kind == "PodDisruptionBudget":
                    self.assertTrue(selects(spec["selector"]["matchLabels"]))
                if kind == "HorizontalPodAutoscaler":
                    target = spec["scaleTargetRef"]
                    self.assertIn((target["kind"], target["name"]), names)
                if kind == "NetworkPolicy" and spec["podSelector"]:
                    self.assertTrue(selects(spec["podSelector"]["matchLabels"]))
        for name, template in pods():
            spec = template["spec"]
            there = {one["name"] for one in spec.get("volumes", [])} | {"data"}
            for one in spec["containers"]:
                for mount in one.get("volumeMounts", []):
                    self.assertIn(mount["name"], there, name)

    def test_scaling_fits_the_proxy(self):
        proxy = (DOCKER / "haproxy.cfg").read_text()
        places = int(re.search(r"server-template \S+ 1-(\d+)", proxy).group(1))
        most = [one["spec"]["maxReplicas"] for _, one in objects()
                if one["kind"] == "HorizontalPodAutoscaler"]
        self.assertEqual(most, [places])

    def test_kustomize_builds(self):
        if not shutil.which("kubectl"):
            self.skip_part("there is no kubectl")
        for folder, least in ((DOCKER, 16), (DOCKER / "kubernetes" / "grade", 1)):
            done = run("kubectl", "kustomize", str(folder))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreaterEqual(len(list(yaml.safe_load_all(done.stdout))), least)

    def test_alerts_ask_for_metrics_there_are(self):
        source = (ROOT / "server" / "metrics.cpp").read_text()
        known = set(re.findall(r'"(farol_\w+)"', source)) | {"up"}
        rules = yaml.safe_load((DOCKER / "alerts.yaml").read_text())
        docs = (ROOT / "docs" / "how-to" / "operator-troubleshoot.md").read_text()
        names = set()
        for group in rules["groups"]:
            for rule in group["rules"]:
                self.assertLessEqual(set(rule), {"alert", "expr", "for", "labels", "annotations"})
                self.assertIn(rule["labels"]["severity"], ("warning", "critical"))
                self.assertIn(f"`{rule['alert']}`", docs, "operator-troubleshoot.md does not explain it")
                names.add(rule["alert"])
                for metric in re.findall(r"\bfarol_\w+", rule["expr"]):
                    self.assertIn(re.sub("_bucket$", "", metric), known, rule["alert"])
        self.assertGreaterEqual(len(names), 8)

    def test_the_alerts_fire_on_what_they_are_for(self):
        promtool = shutil.which("promtool") or shutil.which(str(ROOT / "build/docker/promtool"))
        if not promtool:
            self.skip_part("there is no promtool (scripts/setup docker)")
        rules = yaml.safe_load((DOCKER / "alerts.yaml").read_text())["groups"][0]["rules"]
        cases = (ROOT / "tests" / "docker" / "alerts_test.yaml").read_text()
        for rule in rules:
            self.assertGreaterEqual(cases.count(f"alertname: {rule['alert']}\n"), 1, "no test fires it")
        with tempfile.TemporaryDirectory() as folder:
            here = pathlib.Path(folder)
            settings = (DOCKER / "prometheus.yaml").read_text()
            self.assertIn("/etc/prometheus/alerts.yaml", settings)
            (here / "prometheus.yaml").write_text(settings.replace("/etc/prometheus/", ""))
            (here / "alerts_test.yaml").write_text(cases)
            alerts = (DOCKER / "alerts.yaml").read_text()
            # The second time with alerts that never fire: the cases must see it.
            for text, code in ((alerts, 0), (alerts.replace("> 0.85", "> 1.85"), 1)):
                (here / "alerts.yaml").write_text(text)
                done = run(promtool, "check", "config", "prometheus.yaml", cwd=here)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("SUCCESS", done.stdout)
                done = run(promtool, "test", "rules", "alerts_test.yaml", cwd=here)
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)

    def test_kubernetes_schemas(self):
        if SCRATCH is None:
            self.skip_part("no scratch folder for npm: run by scripts/test docker")
        if not shutil.which("npm"):
            self.skip_part("there is no npm")
        SCRATCH.mkdir(parents=True, exist_ok=True)
        if not (SCRATCH / "node_modules" / "typescript").exists():
            (SCRATCH / "package.json").write_text('{"private":true,"type":"module"}')
            done = run("npm", "install", "--no-audit", "--no-fund", *PACKAGES, cwd=SCRATCH)
            if done.returncode != 0:
                self.skip_part(f"npm cannot install {PACKAGES}: {done.stderr[-300:]}")

        def faults(found):
            """What the TypeScript compiler says of the objects, written as literals of their
            types: it refuses what a type does not have."""
            lines = []
            for i, (_, one) in enumerate(found):
                module, kind = one["apiVersion"], one["kind"]
                lines.append(f'import type {{ I{kind} as T{i} }} from "kubernetes-models/{module}";')
                lines.append(f"export const m{i}: T{i} = {json.dumps(one)};")
            (SCRATCH / "check.ts").write_text("\n".join(lines))
            done = run("node_modules/.bin/tsc", "--noEmit", "--strict", "--skipLibCheck", "--target",
                       "es2022", "--module", "nodenext", "--moduleResolution", "nodenext",
                       "check.ts", cwd=SCRATCH)
            return done.stdout if done.returncode else ""

        found = list(objects())
        self.assertEqual(faults(found), "")
        # The check sees what it is for: an unknown field deep inside, and a wrong type.
        for old, new in (('"periodSeconds"', '"periodSecond"'), ('"maxReplicas": 16', '"maxReplicas": "16"'),
                         ('"readOnlyRootFilesystem"', '"readOnlyRootFileSystem"')):
            text = json.dumps([one for _, one in found])
            self.assertIn(old, text)
            bent = [("", one) for one in json.loads(text.replace(old, new, 1))]
            self.assertNotEqual(faults(bent), "", new)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
