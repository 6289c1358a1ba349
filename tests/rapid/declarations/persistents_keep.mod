! RAPID Kernel, Persistent declarations: components and elements are assigned like those of VAR.
MODULE persistents_keep
  PERS num counts{3}:=[1,2,3];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS num unset;

  PROC main()
    counts{2}:=20;
    wTable.uframe.trans.x:=500;
    unset:=unset+1;
    TPWrite ValToStr(counts);         ! -> [1,20,3]
    TPWrite ValToStr(wTable.uframe);  ! -> [[500,0,0],[1,0,0,0]]
    TPWrite ValToStr(unset);          ! -> 1
  ENDPROC
ENDMODULE
