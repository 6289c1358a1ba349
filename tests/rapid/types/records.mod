! RAPID Kernel, Record types: named components in order; a record may hold records.
MODULE records
  RECORD part
    num number;
    string name;
    pos corner;
  ENDRECORD
  LOCAL RECORD pair
    part left;
    part right;
  ENDRECORD
  VAR pair both:=[[1,"a",[1,2,3]],[2,"b",[4,5,6]]];
  VAR part copy;

  PROC main()
    copy:=both.right;
    copy.corner.z:=60;
    TPWrite ValToStr(copy);             ! -> [2,"b",[4,5,60]]
    TPWrite ValToStr(both.right);       ! -> [2,"b",[4,5,6]]
    both.left:=copy;
    TPWrite both.left.name;             ! -> b
    TPWrite ValToStr(both.left=copy);   ! -> TRUE
    TPWrite ValToStr(both.left<>both.right); ! -> TRUE
    copy:=[both.left.number+1,"c",[0,0,0]];
    TPWrite ValToStr(copy);             ! -> [3,"c",[0,0,0]]
  ENDPROC
ENDMODULE
