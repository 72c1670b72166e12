export const queuePage = {
  title: "Stacks",
  zip: "All as one ZIP",
  forget: "Forget these",
};
