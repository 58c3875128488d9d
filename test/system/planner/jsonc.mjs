// Reads JSON with comments and trailing commas.

export function parse(text) {
  const plain = text.replace(/"(?:[^"\\]|\\.)*"|\/\/[^\n]*|\/\*[\s\S]*?\*\//g, (found) =>
    found[0] === '"' ? found : " ",
  );
  return JSON.parse(plain.replace(/,(\s*[}\]])/g, "$1"));
}
