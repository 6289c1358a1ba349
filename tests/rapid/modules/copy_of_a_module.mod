! Field practice, a folder that holds a module and its copy: told once, not for each name in it.
MODULE copied
  VAR num count;
  PROC main()
    count:=1;
  ENDPROC
ENDMODULE

MODULE Copied   ! error: N202
  VAR num count;
  PROC main()
    count:=2;
  ENDPROC
ENDMODULE
