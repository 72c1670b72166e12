export const samples = {
  title: "Try a sample",
  what: "Rendered objects, to see how it works",
  cancel: "Cancel",
  progress: "Progress of the fetching",
  fetching: (title: string) => `Fetching ${title}`,
  /** Words for samples by their names, in place of those in their list, which are English. */
  words: {} as Readonly<Record<string, { readonly title: string; readonly description: string }>>,
  failed: (path: string, reason: string) => `The sample's file ${path} cannot be fetched: ${reason}`,
  noConnection: (reason: string) => `no connection (${reason})`,
  webPage: "the answer is a web page",
};
