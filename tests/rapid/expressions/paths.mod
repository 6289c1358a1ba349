! RAPID Kernel, Variables: elements and components combine to any depth.
MODULE paths
  RECORD stack
    num height;
    pos corner;
  ENDRECORD
  VAR stack stacks{2,2};
  VAR num a{3}:=[1,2,3];
  VAR num i:=1;
  VAR num x;

  PROC main()
    stacks{2,i+1}.corner.z:=7;
    stacks{a{i}+1,2}.height:=stacks{2,2}.corner.z*2;
    TPWrite ValToStr(stacks{2,2});      ! -> [14,[0,0,7]]
    x:=a{i+1};
    TPWrite ValToStr(x);                ! -> 2
    x:=a{a{a{1}}+a{1}};
    TPWrite ValToStr(x);                ! -> 2
  ENDPROC
ENDMODULE
